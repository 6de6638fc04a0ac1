#include "host/image/jpeg.h"

#include "host/image/image_file.h"

#include <fmt/format.h>

#include <bit>
#include <csetjmp>
#include <cstdio> // jpeglib.h needs it
#include <string>
#include <vector>

#include <jpeglib.h>

#include <jerror.h>

namespace hyalite::core {

namespace {

static_assert(std::endian::native == std::endian::little, "red is written to the lowest byte");

// Each scan covers the whole image: a file of a few kilobytes can have thousands.
constexpr int scanCountMax = 64;

/// libjpeg with error handlers. libjpeg reports errors through functions that must not return, and an exception must
/// not cross its frames. The handlers jump back to decode(), which throws.
struct Decoder {
    jpeg_decompress_struct libjpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf failed{};
    char message[JMSG_LENGTH_MAX]{};

    Decoder() {
        libjpeg.err = jpeg_std_error(&errors);
        errors.error_exit = [](j_common_ptr library) { of(library).fail(); };
        errors.emit_message = [](j_common_ptr library, int level) { of(library).warn(level); };
        progress.progress_monitor = [](j_common_ptr library) { of(library).limitScans(); };
        libjpeg.client_data = this;
    }
    Decoder(const Decoder &) = delete;
    Decoder &operator=(const Decoder &) = delete;
    ~Decoder() { jpeg_destroy_decompress(&libjpeg); }

  private:
    static Decoder &of(j_common_ptr library) { return *static_cast<Decoder *>(library->client_data); }

    [[noreturn]] void fail() {
        errors.format_message(reinterpret_cast<j_common_ptr>(&libjpeg), message);
        std::longjmp(failed, 1);
    }

    /// libjpeg treats damage as a warning and continues with invented data.
    void warn(int level) {
        const bool isHarmless = errors.msg_code == JWRN_EXTRANEOUS_DATA ||
                                errors.msg_code == JWRN_JFIF_MAJOR || errors.msg_code == JWRN_ADOBE_XFORM;
        if (level < 0 && !isHarmless)
            fail();
    }

    void limitScans() {
        if (libjpeg.input_scan_number <= scanCountMax)
            return;
        *fmt::format_to_n(message, JMSG_LENGTH_MAX - 1, "it has more than {} scans", scanCountMax).out = '\0';
        std::longjmp(failed, 1);
    }
};

/// Reads the header and requests RGBA. Returns false on failure. No object here has a destructor: see Decoder.
bool readHeader(Decoder &decoder, std::span<const std::byte> bytes) {
    if (setjmp(decoder.failed) != 0)
        return false;
    jpeg_create_decompress(&decoder.libjpeg);
    decoder.libjpeg.progress = &decoder.progress;
    jpeg_mem_src(&decoder.libjpeg, reinterpret_cast<const unsigned char *>(bytes.data()), bytes.size());
    jpeg_read_header(&decoder.libjpeg, TRUE);
    decoder.libjpeg.out_color_space = JCS_EXT_RGBA;
    return true;
}

/// Decodes the rows. Returns false on failure.
bool readRows(Decoder &decoder, std::uint32_t *levels) {
    if (setjmp(decoder.failed) != 0)
        return false;
    jpeg_start_decompress(&decoder.libjpeg);
    while (decoder.libjpeg.output_scanline < decoder.libjpeg.output_height) {
        JSAMPROW row = reinterpret_cast<JSAMPROW>(levels + std::size_t{decoder.libjpeg.output_scanline} *
                                                               decoder.libjpeg.output_width);
        jpeg_read_scanlines(&decoder.libjpeg, &row, 1);
    }
    jpeg_finish_decompress(&decoder.libjpeg);
    return true;
}

/// Bounds the memory. Besides the levels, a progressive file takes 16 bits per coefficient, in up to three channels
/// with blocks of up to 32 pixels a side.
void requireModestMemory(const InputFile &file, std::uint64_t width, std::uint64_t height) {
    constexpr std::uint64_t besideBytes = std::uint64_t{8} << 20; // rows and tables
    constexpr std::uint64_t blockSide = 32;
    const auto padded = [](std::uint64_t side) { return (side + blockSide - 1) / blockSide * blockSide; };
    requireReadingMemory(file, width, height,
                         width * height * sizeof(std::uint32_t) +
                             padded(width) * padded(height) * 3 * sizeof(std::int16_t) + file.sizeBytes() +
                             besideBytes);
}

} // namespace

bool isJpeg(std::span<const std::byte> head) {
    return head.size() >= 3 && head[0] == std::byte{0xFF} && head[1] == std::byte{0xD8} &&
           head[2] == std::byte{0xFF};
}

Texture readJpeg(const InputFile &file) {
    constexpr std::uint64_t fileBytesMax = std::uint64_t{1} << 30;
    if (file.sizeBytes() > fileBytesMax)
        throw file.bad(fmt::format("it has {} bytes; allowed: at most {}", file.sizeBytes(), fileBytesMax));
    const std::vector<std::byte> bytes = file.head(static_cast<std::size_t>(file.sizeBytes()));
    Decoder decoder;
    if (!readHeader(decoder, bytes))
        throw file.bad(fmt::format("it is damaged: {}", decoder.message));
    const J_COLOR_SPACE space = decoder.libjpeg.jpeg_color_space;
    if (space != JCS_GRAYSCALE && space != JCS_YCbCr && space != JCS_RGB)
        throw file.bad(fmt::format("it has {} channels, as images for print do; allowed: grey and RGB",
                                   decoder.libjpeg.num_components));
    const std::uint64_t width = decoder.libjpeg.image_width;
    const std::uint64_t height = decoder.libjpeg.image_height;
    requireImageSize(file, decoder.libjpeg.image_width, decoder.libjpeg.image_height);
    requireModestMemory(file, width, height);
    Texture texture;
    texture.name = file.path().string();
    texture.width = static_cast<int>(width);
    texture.height = static_cast<int>(height);
    texture.levels.resize(texture.pixelCount());
    if (!readRows(decoder, texture.levels.data()))
        throw file.bad(fmt::format("it is damaged: {}", decoder.message));
    return texture;
}

} // namespace hyalite::core
