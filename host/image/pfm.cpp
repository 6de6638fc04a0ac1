#include "host/image/pfm.h"

#include "host/base/clean_text.h"
#include "host/image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

namespace {

struct PfmHeader {
    int width = 0;
    int height = 0;
    int channelCount = 0;
    std::endian byteOrder = std::endian::little;
    std::size_t sizeBytes = 0; ///< offset of the floats
};

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The words of the header. White space ends each word; after the last one exactly one such byte, then the data begins.
class HeaderWords {
  public:
    HeaderWords(const InputFile &file, std::string_view text) : file_(file), text_(text) {}

    [[nodiscard]] std::string_view next(std::string_view what) {
        while (position_ < text_.size() && isSpace(text_[position_]))
            ++position_;
        const std::size_t begin = position_;
        while (position_ < text_.size() && !isSpace(text_[position_]))
            ++position_;
        if (position_ == text_.size())
            throw file_.bad(fmt::format("its PFM header ends before the {}", what));
        ++position_;
        return text_.substr(begin, position_ - 1 - begin);
    }

    template <typename Number> [[nodiscard]] Number nextNumber(std::string_view what) {
        std::string_view word = next(what);
        const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
        Number value{};
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size()) {
            throw file_.bad(
                fmt::format("the {} in its PFM header is '{}', not a number", what, excerpt(word, 40)));
        }
        return value;
    }

    [[nodiscard]] std::size_t position() const { return position_; }

  private:
    const InputFile &file_;
    std::string_view text_;
    std::size_t position_ = 0;
};

PfmHeader readHeader(const InputFile &file) {
    constexpr std::size_t headerBytesMax = 256;
    const std::vector<std::byte> head = file.head(headerBytesMax);
    HeaderWords words(file, {reinterpret_cast<const char *>(head.data()), head.size()});

    PfmHeader header;
    header.channelCount = words.next("kind") == "PF" ? 3 : 1;
    header.width = words.nextNumber<int>("width");
    header.height = words.nextNumber<int>("height");
    const auto scale = words.nextNumber<double>("scale");
    header.sizeBytes = words.position();

    requireImageSize(file, header.width, header.height);
    const auto pixelCount =
        static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height);
    if (!std::isfinite(scale) || scale == 0.0)
        throw file.bad(fmt::format("the scale in its PFM header is {}, which gives no byte order", scale));
    header.byteOrder = scale < 0.0 ? std::endian::little : std::endian::big;

    const std::uint64_t expectedBytes =
        header.sizeBytes + pixelCount * static_cast<std::uint64_t>(header.channelCount) * sizeof(float);
    if (file.sizeBytes() != expectedBytes) {
        throw file.bad(fmt::format("{} x {} pixels of {} channels make a file of {} bytes, but it has {}",
                                   header.width, header.height, header.channelCount, expectedBytes,
                                   file.sizeBytes()));
    }
    return header;
}

std::uint32_t swapBytes(std::uint32_t word) {
    return (word >> 24) | ((word >> 8) & 0xff00u) | ((word << 8) & 0xff0000u) | (word << 24);
}

std::uint32_t inByteOrder(std::uint32_t word, std::endian order) {
    return order == std::endian::native ? word : swapBytes(word);
}

} // namespace

bool isPfm(std::span<const std::byte> head) {
    return head.size() >= 3 && head[0] == std::byte{'P'} &&
           (head[1] == std::byte{'F'} || head[1] == std::byte{'f'}) && isSpace(static_cast<char>(head[2]));
}

void writePfm(AtomicFile &file, const Image &image) {
    assert(image.width() > 0 && image.height() > 0);
    file.write(fmt::format("PF\n{} {}\n-1.0\n", image.width(), image.height()));
    std::vector<std::uint32_t> row(static_cast<std::size_t>(image.width()) * 3);
    for (int y = image.height() - 1; y >= 0; --y) {
        std::size_t next = 0;
        for (int x = 0; x < image.width(); ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                row[next++] =
                    inByteOrder(std::bit_cast<std::uint32_t>(image.at(x, y)[channel]), std::endian::little);
            }
        }
        file.write(std::as_bytes(std::span(row)));
    }
}

Image readPfm(const InputFile &file) {
    const PfmHeader header = readHeader(file);
    Image image(header.width, header.height);
    std::vector<std::uint32_t> row(static_cast<std::size_t>(header.width) *
                                   static_cast<std::size_t>(header.channelCount));
    const auto rowBytes = std::as_writable_bytes(std::span(row));
    std::uint64_t offsetBytes = header.sizeBytes;
    for (int y = header.height - 1; y >= 0; --y) {
        file.read(offsetBytes, rowBytes);
        offsetBytes += rowBytes.size();
        std::size_t next = 0;
        for (int x = 0; x < header.width; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                const std::size_t index = header.channelCount == 3 ? next++ : static_cast<std::size_t>(x);
                image.at(x, y)[channel] = std::bit_cast<float>(inByteOrder(row[index], header.byteOrder));
            }
        }
    }
    return image;
}

} // namespace hyalite::core
