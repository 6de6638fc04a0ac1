#include "host/image/png_chunks.h"

#include "host/image/image_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace hyalite {

namespace {

constexpr std::uint64_t signatureBytes = 8;
constexpr std::uint64_t chunkFrameBytes = 12; ///< length, type, checksum
constexpr std::size_t headerBytes = 13;
/// stb_image counts in an int, and the compressed data may be a little more than twice as large (see readPixels).
constexpr std::uint64_t rowDataBytesMax = (std::uint64_t{1} << 30) - (std::uint64_t{1} << 20);

enum ColourType : int { grey = 0, rgb = 2, palette = 3, greyAlpha = 4, rgbAlpha = 6 };

struct Header {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int bitDepth = 0;
    int colourType = 0;
    bool interlaced = false;
};

std::uint32_t bigEndian32(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value = (value << 8) | std::to_integer<std::uint32_t>(bytes[i]);
    }
    return value;
}

void appendBigEndian32(std::vector<std::byte> &bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes.push_back(static_cast<std::byte>((value >> shift) & 0xffu));
    }
}

/// CRC-32 of ISO 3309, as in annex D of the PNG standard.
std::uint32_t checksumOf(std::span<const std::byte> bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const unsigned char *>(bytes.data()), bytes.size()));
}

bool isLegalDepth(int colourType, int bitDepth) {
    switch (colourType) {
    case grey:
        return bitDepth == 1 || bitDepth == 2 || bitDepth == 4 || bitDepth == 8 || bitDepth == 16;
    case palette:
        return bitDepth == 1 || bitDepth == 2 || bitDepth == 4 || bitDepth == 8;
    case rgb:
    case greyAlpha:
    case rgbAlpha:
        return bitDepth == 8 || bitDepth == 16;
    default:
        return false;
    }
}

std::uint64_t channelCount(int colourType) {
    switch (colourType) {
    case rgb:
        return 3;
    case greyAlpha:
        return 2;
    case rgbAlpha:
        return 4;
    default:
        return 1;
    }
}

Header parseHeader(const InputFile &file, std::span<const std::byte> data) {
    Header header;
    header.width = bigEndian32(data);
    header.height = bigEndian32(data.subspan(4));
    header.bitDepth = std::to_integer<int>(data[8]);
    header.colourType = std::to_integer<int>(data[9]);
    const int compression = std::to_integer<int>(data[10]);
    const int filter = std::to_integer<int>(data[11]);
    const int interlace = std::to_integer<int>(data[12]);
    requireImageSize(file, header.width, header.height);
    if (!isLegalDepth(header.colourType, header.bitDepth)) {
        throw file.bad(fmt::format("its PNG header says colour type {} with {} bits, which PNG does not have",
                                   header.colourType, header.bitDepth));
    }
    if (compression != 0 || filter != 0 || interlace > 1) {
        throw file.bad(
            fmt::format("its PNG header says compression {}, filter {}, interlace {}; known are 0, 0, "
                        "and 0 or 1",
                        compression, filter, interlace));
    }
    header.interlaced = interlace == 1;
    return header;
}

/// Size of the decompressed rows, each with a filter byte. An interlaced image has seven reduced images (Adam7).
std::uint64_t rowDataBytesOf(const Header &header) {
    struct Pass {
        std::uint32_t x, y, stepX, stepY;
    };
    static constexpr std::array<Pass, 7> adam7 = {
        {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
    static constexpr std::array<Pass, 1> whole = {{{0, 0, 1, 1}}};

    const std::uint64_t pixelBits =
        channelCount(header.colourType) * static_cast<std::uint64_t>(header.bitDepth);
    std::uint64_t total = 0;
    for (const Pass &pass : header.interlaced ? std::span<const Pass>(adam7) : std::span<const Pass>(whole)) {
        const std::uint64_t width =
            (header.width + pass.stepX - 1 - std::min(pass.x, header.width)) / pass.stepX;
        const std::uint64_t height =
            (header.height + pass.stepY - 1 - std::min(pass.y, header.height)) / pass.stepY;
        total += width == 0 ? 0 : height * (1 + (width * pixelBits + 7) / 8);
    }
    return total;
}

/// Reads the chunks one after the other and collects the palette, its transparency and the pixels. What follows the last
/// chunk is padding.
class ChunkReader {
  public:
    explicit ChunkReader(const InputFile &file) : file_(file) {}

    PngChunks read() {
        readHeaderChunk();
        while (!atEnd_) {
            readNextChunk();
        }
        if (compressed_.empty()) {
            throw file_.bad("it has no pixel data");
        }
        // Deflate encodes at most 258 bytes in 2 bits: a ratio of 1032.
        if (rowDataBytes_ / 1032 > compressed_.size()) {
            throw file_.bad(fmt::format("{} x {} pixels cannot be packed in {} bytes", header_.width,
                                        header_.height, compressed_.size()));
        }
        requireModestMemory();
        return assemble();
    }

  private:
    struct Frame {
        std::uint32_t sizeBytes = 0;
        std::array<char, 4> type{};

        [[nodiscard]] std::string_view name() const { return {type.data(), type.size()}; }
    };

    Frame readFrame() {
        if (file_.sizeBytes() - offsetBytes_ < chunkFrameBytes) {
            throw file_.bad("it ends before the end of the PNG");
        }
        std::array<std::byte, 8> bytes{};
        file_.read(offsetBytes_, bytes);
        Frame frame;
        frame.sizeBytes = bigEndian32(bytes);
        for (std::size_t i = 0; i < 4; ++i) {
            frame.type[i] = static_cast<char>(bytes[4 + i]);
            if (!((frame.type[i] >= 'A' && frame.type[i] <= 'Z') ||
                  (frame.type[i] >= 'a' && frame.type[i] <= 'z'))) {
                throw file_.bad(fmt::format("no PNG chunk begins at byte {}", offsetBytes_));
            }
        }
        if (frame.sizeBytes > file_.sizeBytes() - offsetBytes_ - chunkFrameBytes) {
            throw file_.bad(
                fmt::format("it ends within the {} chunk at byte {}", frame.name(), offsetBytes_));
        }
        return frame;
    }

    /// The data of the current chunk. The caller has checked its size.
    std::vector<std::byte> readData(const Frame &frame) {
        std::vector<std::byte> bytes(std::size_t{frame.sizeBytes} + 8); // type, data, checksum
        file_.read(offsetBytes_ + 4, bytes);
        const auto checked = std::span(bytes).first(bytes.size() - 4);
        if (checksumOf(checked) != bigEndian32(std::span(bytes).last(4))) {
            throw file_.bad(
                fmt::format("the {} chunk at byte {} has a wrong checksum", frame.name(), offsetBytes_));
        }
        return {bytes.begin() + 4, bytes.end() - 4};
    }

    void readHeaderChunk() {
        offsetBytes_ = signatureBytes;
        const Frame frame = readFrame();
        if (frame.name() != "IHDR" || frame.sizeBytes != headerBytes) {
            throw file_.bad("its first chunk is not a PNG header");
        }
        headerData_ = readData(frame);
        header_ = parseHeader(file_, headerData_);
        rowDataBytes_ = rowDataBytesOf(header_);
        if (rowDataBytes_ > rowDataBytesMax) {
            throw file_.bad(
                fmt::format("its pixels take {} bytes, more than this program decompresses", rowDataBytes_));
        }
        offsetBytes_ += chunkFrameBytes + frame.sizeBytes;
    }

    /// Bounds the memory. Pixels may be compressed a thousandfold, so that a small file could allocate gigabytes. The
    /// peak holds the levels from stb_image and the floats of an Image. Decompression takes less, except for interlaced
    /// images, whose reduced images exist beside the whole.
    void requireModestMemory() const {
        // The compressed pixels and the other chunks.
        constexpr std::uint64_t besideBytes = std::uint64_t{16} << 20;
        const std::uint64_t levelBytes = header_.bitDepth == 16 ? 2 : 1;
        const std::uint64_t pixelBytes = sizeof(glm::vec3) + levelBytes * (header_.interlaced ? 8 : 4);
        requireReadingMemory(file_, header_.width, header_.height,
                             std::uint64_t{header_.width} * header_.height * pixelBytes + besideBytes);
    }

    void readNextChunk() {
        const Frame frame = readFrame();
        if (frame.name() == "IDAT") {
            readPixels(frame);
        } else if (frame.name() == "PLTE") {
            if (!palette_.empty() || !compressed_.empty() || frame.sizeBytes == 0 || frame.sizeBytes > 768 ||
                frame.sizeBytes % 3 != 0) {
                throw file_.bad(
                    fmt::format("its palette of {} bytes is misplaced or of no legal size", frame.sizeBytes));
            }
            palette_ = readData(frame);
        } else if (frame.name() == "tRNS") {
            readTransparency(frame);
        } else if (frame.name() == "IEND") {
            if (frame.sizeBytes != 0) {
                throw file_.bad("its end chunk is not empty");
            }
            (void)readData(frame);
            atEnd_ = true;
        } else if (frame.type[0] >= 'A' &&
                   frame.type[0] <=
                       'Z') { // critical chunk: a reader that does not know it cannot show the picture
            throw file_.bad(
                fmt::format("it has an unexpected {} chunk at byte {}", frame.name(), offsetBytes_));
        }
        lastWasPixels_ = frame.name() == "IDAT";
        offsetBytes_ += chunkFrameBytes + frame.sizeBytes;
    }

    /// Of a palette the alpha of each colour, else the one colour that is transparent. One that is misplaced is no use.
    void readTransparency(const Frame &frame) {
        const bool isUsable = header_.colourType == palette
                                  ? !palette_.empty() && frame.sizeBytes <= palette_.size() / 3
                                  : (header_.colourType == grey && frame.sizeBytes == 2) ||
                                        (header_.colourType == rgb && frame.sizeBytes == 6);
        if (isUsable && compressed_.empty() && transparency_.empty())
            transparency_ = readData(frame);
    }

    void readPixels(const Frame &frame) {
        if (!compressed_.empty() && !lastWasPixels_) {
            throw file_.bad("its pixel data is interrupted by another chunk");
        }
        // Uncompressed blocks add 5 bytes each. No encoder exceeds twice the size by more than 64 KiB.
        const std::uint64_t boundBytes = 2 * rowDataBytes_ + 65536;
        if (compressed_.size() + std::uint64_t{frame.sizeBytes} > boundBytes) {
            throw file_.bad(fmt::format("it has more than {} bytes of pixel data for {} x {} pixels",
                                        boundBytes, header_.width, header_.height));
        }
        const std::vector<std::byte> data = readData(frame);
        compressed_.insert(compressed_.end(), data.begin(), data.end());
    }

    PngChunks assemble() {
        PngChunks chunks;
        chunks.width = static_cast<int>(header_.width);
        chunks.height = static_cast<int>(header_.height);
        chunks.bitDepth = header_.bitDepth;
        chunks.rowDataBytes = rowDataBytes_;
        chunks.minimal = file_.head(signatureBytes);
        appendChunk(chunks.minimal, "IHDR", headerData_);
        if (header_.colourType == palette) {
            if (palette_.empty()) {
                throw file_.bad("it has no palette, but its pixels are indices into one");
            }
            // An index past the end of the palette shows black instead of uninitialised memory of stb_image.
            palette_.resize(768, std::byte{0});
            appendChunk(chunks.minimal, "PLTE", palette_);
        }
        if (!transparency_.empty())
            appendChunk(chunks.minimal, "tRNS", transparency_);
        chunks.compressedOffset = chunks.minimal.size() + 8;
        chunks.compressedBytes = compressed_.size();
        appendChunk(chunks.minimal, "IDAT", compressed_);
        appendChunk(chunks.minimal, "IEND", {});
        return chunks;
    }

    const InputFile &file_;
    std::uint64_t offsetBytes_ = 0;
    bool atEnd_ = false;
    bool lastWasPixels_ = false;
    Header header_;
    std::uint64_t rowDataBytes_ = 0;
    std::vector<std::byte> headerData_;
    std::vector<std::byte> palette_;
    std::vector<std::byte> transparency_;
    std::vector<std::byte> compressed_;
};

} // namespace

void appendChunk(std::vector<std::byte> &file, std::string_view type, std::span<const std::byte> data) {
    appendBigEndian32(file, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = file.size();
    for (const char c : type) {
        file.push_back(static_cast<std::byte>(c));
    }
    file.insert(file.end(), data.begin(), data.end());
    appendBigEndian32(file, checksumOf(std::span(file).subspan(begin)));
}

PngChunks readPngChunks(const InputFile &file) { return ChunkReader(file).read(); }

} // namespace hyalite
