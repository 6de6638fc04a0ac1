#include "host/image/hdr.h"

#include "host/base/clean_text.h"
#include "host/image/image_file.h"

#include <glm/common.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr int exponentBias = 128;   ///< a mantissa of 256 with this exponent is 1
constexpr int runLengthSideMin = 8; ///< other rows, shorter or longer, are not encoded
constexpr int runLengthSideMax = 32767;

Rgbe encode(const glm::vec3 &colour) {
    // The largest value: 255 / 256 * 2^127.
    const float largest = std::ldexp(255.0f, 119);
    const auto bounded = [&](float value) {
        return value > 0.0f ? std::min(value, largest) : 0.0f;
    }; // NaN: 0
    const glm::vec3 positive(bounded(colour.x), bounded(colour.y), bounded(colour.z));
    const float maximum = std::max({positive.x, positive.y, positive.z});
    int exponent = 0;
    if (std::frexp(maximum, &exponent) * 256.0f >= 255.5f) // it would be rounded to 256
        ++exponent;
    if (maximum == 0.0f || exponent <= -exponentBias)
        return {};
    const auto mantissa = [&](float value) {
        return static_cast<std::uint8_t>(std::nearbyint(std::ldexp(value, 8 - exponent)));
    };
    return {mantissa(positive.x), mantissa(positive.y), mantissa(positive.z),
            static_cast<std::uint8_t>(exponent + exponentBias)};
}

/// Appends one channel of a row: runs of 3 to 127 equal bytes as (128 + length, byte), others as (length, bytes), up to
/// 128 of them.
void packRuns(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t> &packed) {
    constexpr std::size_t runMin = 3;
    constexpr std::size_t runMax = 127;
    constexpr std::size_t plainMax = 128;
    const auto runAt = [&](std::size_t begin) {
        std::size_t end = begin + 1;
        while (end < bytes.size() && end - begin < runMax && bytes[end] == bytes[begin])
            ++end;
        return end - begin;
    };
    for (std::size_t begin = 0; begin < bytes.size();) {
        if (const std::size_t run = runAt(begin); run >= runMin) {
            packed.push_back(static_cast<std::uint8_t>(128 + run));
            packed.push_back(bytes[begin]);
            begin += run;
            continue;
        }
        std::size_t end = begin + 1;
        while (end < bytes.size() && end - begin < plainMax && runAt(end) < runMin)
            ++end;
        packed.push_back(static_cast<std::uint8_t>(end - begin));
        packed.insert(packed.end(), bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                      bytes.begin() + static_cast<std::ptrdiff_t>(end));
        begin = end;
    }
}

std::vector<std::uint8_t> packRow(std::span<const Rgbe> row) {
    std::vector<std::uint8_t> packed;
    if (row.size() < runLengthSideMin || row.size() > runLengthSideMax) {
        for (const Rgbe &pixel : row)
            packed.insert(packed.end(), pixel.begin(), pixel.end());
        return packed;
    }
    packed = {2, 2, static_cast<std::uint8_t>(row.size() >> 8), static_cast<std::uint8_t>(row.size() & 0xff)};
    std::vector<std::uint8_t> channelBytes(row.size());
    for (std::size_t channel = 0; channel < 4; ++channel) {
        std::transform(row.begin(), row.end(), channelBytes.begin(),
                       [channel](const Rgbe &pixel) { return pixel[channel]; });
        packRuns(channelBytes, packed);
    }
    return packed;
}

/// Buffered sequential reading of a file.
class ByteStream {
  public:
    explicit ByteStream(const InputFile &file) : file_(file) {}

    [[nodiscard]] std::uint8_t next() {
        if (position_ == buffer_.size())
            refill();
        return static_cast<std::uint8_t>(buffer_[position_++]);
    }
    [[nodiscard]] std::uint64_t remaining() const {
        return file_.sizeBytes() - offset_ + (buffer_.size() - position_);
    }

  private:
    void refill() {
        constexpr std::uint64_t bufferBytes = 65536;
        buffer_.resize(static_cast<std::size_t>(std::min(bufferBytes, file_.sizeBytes() - offset_)));
        if (buffer_.empty())
            throw file_.bad("it is cut short");
        file_.read(offset_, buffer_);
        offset_ += buffer_.size();
        position_ = 0;
    }

    const InputFile &file_;
    std::uint64_t offset_ = 0; ///< file offset of the byte after the buffer
    std::vector<std::byte> buffer_;
    std::size_t position_ = 0;
};

/// The next line of the header, without its line end.
std::string nextLine(const InputFile &file, ByteStream &stream, std::size_t &headerBytes) {
    constexpr std::size_t headerBytesMax = 65536;
    std::string line;
    for (char c = static_cast<char>(stream.next()); c != '\n'; c = static_cast<char>(stream.next())) {
        if (++headerBytes > headerBytesMax)
            throw file.bad(fmt::format("its header is longer than {} bytes", headerBytesMax));
        line += c;
    }
    if (line.ends_with('\r'))
        line.pop_back();
    return line;
}

/// A size and an orientation. Rows are as the file has them: lines of the picture, or its columns where `isTurned`.
struct Layout {
    int rowCount = 0;
    int rowLength = 0;
    bool isTurned = false;
    bool isRowReversed = false;    ///< the first row is the last line or column
    bool isWithinReversed = false; ///< the first pixel of a row is its last

    [[nodiscard]] int width() const { return isTurned ? rowCount : rowLength; }
    [[nodiscard]] int height() const { return isTurned ? rowLength : rowCount; }
};

/// From `-Y HEIGHT +X WIDTH`, or any other order and signs: what stands first counts rows; Y goes up, X to the right.
Layout parseLayout(const InputFile &file, const std::string &line) {
    static_assert(imageSideMax < 999999, "six digits are read");
    Layout layout;
    std::array<char, 2> sign{};
    std::array<char, 2> axis{};
    int length = 0;
    if (std::sscanf(line.c_str(), "%c%c %6d %c%c %6d%n", sign.data(), axis.data(), &layout.rowCount, &sign[1],
                    &axis[1], &layout.rowLength, &length) != 6 ||
        static_cast<std::size_t>(length) != line.size() || (axis[0] == 'Y') == (axis[1] == 'Y') ||
        (axis[0] != 'Y' && axis[0] != 'X') || (axis[1] != 'Y' && axis[1] != 'X') ||
        std::ranges::any_of(sign, [](char c) { return c != '+' && c != '-'; }))
        throw file.bad(
            fmt::format("its size is given as '{}'; allowed: -Y HEIGHT +X WIDTH, in any order and with any "
                        "signs",
                        excerpt(line, 40)));
    const auto isReversed = [&](std::size_t i) { return (axis[i] == 'Y') == (sign[i] == '+'); };
    layout.isTurned = axis[0] == 'X';
    layout.isRowReversed = isReversed(0);
    layout.isWithinReversed = isReversed(1);
    return layout;
}

/// Reads the header, and checks that there is memory for the picture.
Layout readHeader(const InputFile &file, ByteStream &stream) {
    std::size_t headerBytes = 0;
    std::string line = nextLine(file, stream, headerBytes); // #?RADIANCE
    for (line = nextLine(file, stream, headerBytes); !line.empty();
         line = nextLine(file, stream, headerBytes))
        if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
            throw file.bad(
                fmt::format("its header says {}; FORMAT=32-bit_rle_rgbe is read", excerpt(line, 40)));
    const Layout layout = parseLayout(file, nextLine(file, stream, headerBytes));
    requireImageSize(file, layout.width(), layout.height());
    if (stream.remaining() <
        4 * static_cast<std::uint64_t>(layout.rowCount)) // a row has a pixel or a run-length head
        throw file.bad("it is cut short");
    const auto pixelCount =
        static_cast<std::uint64_t>(layout.rowCount) * static_cast<std::uint64_t>(layout.rowLength);
    constexpr std::uint64_t besideBytes = std::uint64_t{4} << 20; // a row and the file's buffer
    requireReadingMemory(file, static_cast<std::uint64_t>(layout.width()),
                         static_cast<std::uint64_t>(layout.height()),
                         pixelCount * sizeof(glm::vec3) + besideBytes);
    return layout;
}

[[noreturn]] void refuseRow(const InputFile &file, int y) {
    throw file.bad(fmt::format("the runs of its row {} do not add up to the width", y));
}

/// Reads a row of four run-length encoded channels, one after the other; see packRuns().
void readRuns(const InputFile &file, ByteStream &stream, int y, std::span<Rgbe> row) {
    for (std::size_t channel = 0; channel < 4; ++channel)
        for (std::size_t x = 0; x < row.size();) {
            const std::uint8_t head = stream.next();
            const bool isRun = head > 128;
            const std::size_t count = isRun ? head - 128u : head;
            if (count == 0 || count > row.size() - x)
                refuseRow(file, y);
            std::uint8_t byte = 0;
            for (std::size_t i = 0; i < count; ++i) {
                if (i == 0 || !isRun)
                    byte = stream.next();
                row[x++][channel] = byte;
            }
        }
}

/// Reads a row of whole pixels. The marker (1, 1, 1, n) repeats the last pixel n times; a marker directly after another
/// one counts 256 times as much.
void readPixels(const InputFile &file, ByteStream &stream, int y, const Rgbe &first, std::span<Rgbe> row) {
    unsigned shift = 0;
    Rgbe pixel = first;
    for (std::size_t x = 0; x < row.size();) {
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            const std::uint64_t count = shift < 32 ? std::uint64_t{pixel[3]} << shift : row.size() + 1;
            if (x == 0 || count > row.size() - x)
                refuseRow(file, y);
            std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
            x += static_cast<std::size_t>(count);
            shift += 8;
        } else {
            row[x++] = pixel;
            shift = 0;
        }
        if (x < row.size())
            for (std::uint8_t &byte : pixel)
                byte = stream.next();
    }
}

void readRow(const InputFile &file, ByteStream &stream, int y, std::span<Rgbe> row) {
    Rgbe first;
    for (std::uint8_t &byte : first)
        byte = stream.next();
    const std::size_t widthInRow = std::size_t{first[2]} << 8 | first[3];
    if (row.size() >= runLengthSideMin && row.size() <= runLengthSideMax && first[0] == 2 && first[1] == 2 &&
        widthInRow == row.size())
        readRuns(file, stream, y, row);
    else
        readPixels(file, stream, y, first, row);
}

glm::vec3 decode(const Rgbe &pixel) {
    const float scale = std::ldexp(1.0f, pixel[3] - exponentBias - 8);
    return pixel[3] == 0 ? glm::vec3(0.0f) : scale * glm::vec3(pixel[0], pixel[1], pixel[2]);
}

} // namespace

bool isHdr(std::span<const std::byte> head) {
    return head.size() >= 2 && head[0] == std::byte{'#'} && head[1] == std::byte{'?'};
}

Image readHdr(const InputFile &file) {
    ByteStream stream(file);
    const Layout layout = readHeader(file, stream);
    Image image(layout.width(), layout.height());
    std::vector<Rgbe> row(static_cast<std::size_t>(layout.rowLength));
    for (int i = 0; i < layout.rowCount; ++i) {
        readRow(file, stream, i, row);
        const int major = layout.isRowReversed ? layout.rowCount - 1 - i : i;
        for (int j = 0; j < layout.rowLength; ++j) {
            const int minor = layout.isWithinReversed ? layout.rowLength - 1 - j : j;
            (layout.isTurned ? image.at(major, minor) : image.at(minor, major)) =
                decode(row[static_cast<std::size_t>(j)]);
        }
    }
    return image; // what follows is padding
}

void writeHdr(AtomicFile &file, const Image &image) {
    assert(image.width() > 0 && image.height() > 0);
    file.write(
        fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height(), image.width()));
    std::vector<Rgbe> row(static_cast<std::size_t>(image.width()));
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x)
            row[static_cast<std::size_t>(x)] = encode(image.at(x, y));
        file.write(std::as_bytes(std::span<const std::uint8_t>(packRow(row))));
    }
}

} // namespace hyalite::core
