#include "host/image/png.h"

#include "host/base/error.h"
#include "host/image/image_limits.h"
#include "host/image/png_text.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <csetjmp>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// stb does not compile cleanly under our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace hyalite::core {

namespace {

/// Callback of stb, which calls it with the whole encoded file. An exception must not cross the frames of stb.
void appendBytes(void *context, void *data, int sizeBytes) {
    auto &file = *static_cast<std::optional<std::vector<std::byte>> *>(context);
    const auto *begin = static_cast<const std::byte *>(data);
    try {
        file.emplace(begin, begin + sizeBytes);
    } catch (const std::bad_alloc &) {
        file.reset();
    }
}

/// `name` is for messages.
std::vector<std::byte> encode(const std::filesystem::path &name, int width, int height,
                              std::span<const std::uint8_t> levels, std::span<const Attribute> attributes) {
    assert(width > 0 && height > 0);
    const std::size_t pixelCount = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    assert(levels.size() == 3 * pixelCount || levels.size() == 4 * pixelCount);
    const int channelCount = levels.size() == 3 * pixelCount ? 3 : 4;
    requirePngSize(name, width, height);
    // Rendered pictures have large flat areas: without row filters they compress twice as fast, to about the same size.
    stbi_write_force_png_filter = 0;
    stbi_write_png_compression_level = 5;
    std::optional<std::vector<std::byte>> file;
    const int written = stbi_write_png_to_func(appendBytes, &file, width, height, channelCount, levels.data(),
                                               width * channelCount);
    if (written == 0 || !file) {
        throw Error(ErrorKind::LimitExceeded, fmt::format("'{}': no memory to pack a PNG of {} x {} pixels",
                                                          name.string(), width, height));
    }
    insertTexts(*file, attributes);
    return std::move(*file);
}

static_assert(std::endian::native == std::endian::little, "red is written to the lowest byte");

/// libpng with the file that it reads. It reports errors through a function that must not return, and an exception must
/// not cross its frames: fail() jumps back to readPngInfo() or readPngLevels(), whose callers refuse().
struct PngDecoder {
    const InputFile &file;
    png_structp png;
    png_infop info;
    std::jmp_buf failed{};
    std::uint64_t offsetBytes = 0;
    std::exception_ptr readFailure;
    char message[256]{};

    explicit PngDecoder(const InputFile &input)
        : file(input), png(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, warn)),
          info(png_create_info_struct(png)) {
        if (info != nullptr)
            return;
        png_destroy_read_struct(&png, nullptr, nullptr);
        throw std::bad_alloc();
    }
    PngDecoder(const PngDecoder &) = delete;
    PngDecoder &operator=(const PngDecoder &) = delete;
    ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }

    [[nodiscard]] int width() const { return static_cast<int>(png_get_image_width(png, info)); }
    [[nodiscard]] int height() const { return static_cast<int>(png_get_image_height(png, info)); }
    [[nodiscard]] bool has16Bits() const { return png_get_bit_depth(png, info) == 16; }
    /// In a channel, a palette or of one colour.
    [[nodiscard]] bool hasAlpha() const {
        return (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
               png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    }

    [[noreturn]] void refuse() const {
        if (readFailure)
            std::rethrow_exception(readFailure);
        throw file.bad(fmt::format("it is damaged near byte {}: {}", offsetBytes, message));
    }

    static void read(png_structp png, png_bytep destination, std::size_t sizeBytes) {
        auto &decoder = *static_cast<PngDecoder *>(png_get_io_ptr(png));
        if (sizeBytes > decoder.file.sizeBytes() - decoder.offsetBytes)
            png_error(png, "it ends before the end of the PNG");
        try {
            decoder.file.read(decoder.offsetBytes, {reinterpret_cast<std::byte *>(destination), sizeBytes});
        } catch (...) {
            decoder.readFailure = std::current_exception();
        }
        if (decoder.readFailure)
            png_error(png, "it cannot be read");
        decoder.offsetBytes += sizeBytes;
    }

  private:
    [[noreturn]] static void fail(png_structp png, png_const_charp what) {
        auto &decoder = *static_cast<PngDecoder *>(png_get_error_ptr(png));
        *fmt::format_to_n(decoder.message, sizeof(decoder.message) - 1, "{}", what).out = '\0';
        std::longjmp(decoder.failed, 1);
    }

    /// libpng treats much damage as a warning, which begins with the name of the chunk. Ancillary chunks, whose names
    /// begin with a small letter, may be wrong: only transparency is read of them.
    static void warn(png_structp png, png_const_charp what) {
        const std::string_view text = what;
        const bool isAncillary = text.front() >= 'a' && text.front() <= 'z';
        const bool isHarmless = (isAncillary && text != "tRNS: CRC error") ||
                                text == "IDAT: Extra compressed data" ||
                                text == "PLTE: ignored in grayscale PNG";
        if (!isHarmless)
            fail(png, what);
    }
};

/// Reads what precedes the pixels. Returns false on failure. No object here has a destructor: see PngDecoder.
bool readPngInfo(PngDecoder &decoder) {
    if (setjmp(decoder.failed) != 0)
        return false;
    png_set_read_fn(decoder.png, &decoder, PngDecoder::read);
    // Ancillary chunks other than tRNS are passed over, however long, and not unpacked.
    png_set_keep_unknown_chunks(decoder.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    // Some encoders state a smaller window than their pixels need.
    png_set_option(decoder.png, PNG_MAXIMUM_INFLATE_WINDOW, PNG_OPTION_ON);
    png_read_info(decoder.png, decoder.info);
    return true;
}

/// Decodes the pixels to `channelCount` levels each, the fourth of which is alpha, and reads on to the end. Levels of 16
/// bits become those of 8 unless they are kept. Returns false on failure.
bool readPngLevels(PngDecoder &decoder, std::span<std::byte> levels, int channelCount, bool keeps16Bits) {
    if (setjmp(decoder.failed) != 0)
        return false;
    png_set_expand(decoder.png);
    png_set_gray_to_rgb(decoder.png);
    if (keeps16Bits)
        png_set_swap(decoder.png); // to little-endian
    else
        png_set_strip_16(decoder.png);
    if (channelCount == 4)
        png_set_add_alpha(decoder.png, 255, PNG_FILLER_AFTER); // unless it has some
    else
        png_set_strip_alpha(decoder.png);
    const int passCount = png_set_interlace_handling(decoder.png);
    png_read_update_info(decoder.png, decoder.info);
    const std::size_t rowBytes = png_get_rowbytes(decoder.png, decoder.info);
    assert(rowBytes * static_cast<std::size_t>(decoder.height()) == levels.size());
    for (int pass = 0; pass < passCount; ++pass)
        for (std::size_t begin = 0; begin < levels.size(); begin += rowBytes)
            png_read_row(decoder.png, reinterpret_cast<png_bytep>(&levels[begin]), nullptr);
    png_read_end(decoder.png, decoder.info);
    return true;
}

/// Bounds the memory. Pixels may be compressed a thousandfold, so that a small file could allocate gigabytes. The peak
/// holds the levels and the floats of an Image.
void requirePngMemory(const PngDecoder &decoder, bool wantsAlpha) {
    constexpr std::uint64_t besideBytes = std::uint64_t{2} << 20; // rows and tables
    const std::uint64_t channelCount = wantsAlpha && decoder.hasAlpha() ? 4 : 3;
    constexpr std::uint64_t deflateRatioMax = 1032; // 258 bytes in 2 bits
    const std::uint64_t width = png_get_image_width(decoder.png, decoder.info);
    const std::uint64_t height = png_get_image_height(decoder.png, decoder.info);
    requireImageSize(decoder.file, static_cast<std::int64_t>(width), static_cast<std::int64_t>(height));
    if (height * png_get_rowbytes(decoder.png, decoder.info) / deflateRatioMax > decoder.file.sizeBytes())
        throw decoder.file.bad(fmt::format("{} x {} pixels cannot be packed in {} bytes", width, height,
                                           decoder.file.sizeBytes()));
    requireReadingMemory(decoder.file, width, height,
                         width * height * channelCount * (sizeof(float) + (decoder.has16Bits() ? 2 : 1)) +
                             besideBytes);
}

void beginPng(PngDecoder &decoder, bool wantsAlpha) {
    if (!readPngInfo(decoder))
        decoder.refuse();
    requirePngMemory(decoder, wantsAlpha);
}

template <typename Level> AlphaImage decodePng(PngDecoder &decoder, float levelMax) {
    AlphaImage decoded{Image(decoder.width(), decoder.height()), {}};
    std::vector<glm::vec3> &pixels = decoded.image.pixels();
    const std::size_t channelCount = decoder.hasAlpha() ? 4 : 3;
    std::vector<Level> levels(channelCount * pixels.size());
    if (!readPngLevels(decoder, std::as_writable_bytes(std::span(levels)), static_cast<int>(channelCount),
                       sizeof(Level) == 2))
        decoder.refuse();
    if (channelCount == 4)
        decoded.alpha.resize(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Level *level = &levels[channelCount * i];
        pixels[i] = glm::vec3(level[0], level[1], level[2]) / levelMax;
        if (channelCount == 4)
            decoded.alpha[i] = static_cast<float>(level[3]) / levelMax;
    }
    return decoded;
}

} // namespace

bool isPng(std::span<const std::byte> head) {
    constexpr std::size_t signatureBytes = 8;
    return head.size() >= signatureBytes &&
           png_sig_cmp(reinterpret_cast<png_const_bytep>(head.data()), 0, signatureBytes) == 0;
}

void requirePngSize(const std::filesystem::path &name, int width, int height) {
    const auto pixelCount = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (pixelCount > imagePixelCountMax) { // stb counts bytes in an int
        throw Error(
            ErrorKind::LimitExceeded,
            fmt::format("'{}': a PNG of {} x {} pixels is more than {}; write a .pfm, or a smaller image",
                        name.string(), width, height, imagePixelCountMax));
    }
}

void writePng(AtomicFile &file, int width, int height, std::span<const std::uint8_t> levels,
              std::span<const Attribute> attributes) {
    file.write(encode(file.path(), width, height, levels, attributes));
}

std::vector<std::byte> encodePng(int width, int height, std::span<const std::uint8_t> levels,
                                 std::span<const Attribute> attributes) {
    return encode("the image", width, height, levels, attributes);
}

Texture readPngTexture(const InputFile &file) {
    PngDecoder decoder(file);
    beginPng(decoder, false); // four bytes a pixel: less than floats
    Texture texture;
    texture.name = file.path().string();
    texture.width = decoder.width();
    texture.height = decoder.height();
    texture.hasAlpha = decoder.hasAlpha();
    texture.levels.resize(texture.pixelCount());
    if (!readPngLevels(decoder, std::as_writable_bytes(std::span(texture.levels)), 4, false))
        decoder.refuse();
    return texture;
}

AlphaImage readPng(const InputFile &file) {
    PngDecoder decoder(file);
    beginPng(decoder, true);
    return decoder.has16Bits() ? decodePng<std::uint16_t>(decoder, 65535.0f)
                               : decodePng<std::uint8_t>(decoder, 255.0f);
}

} // namespace hyalite::core
