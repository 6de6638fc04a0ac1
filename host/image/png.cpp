#include "host/image/png.h"

#include "host/base/error.h"
#include "host/image/image_file.h"
#include "host/image/png_chunks.h"
#include "host/image/png_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <new>
#include <optional>
#include <vector>

// stb does not compile cleanly under our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace hyalite {

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
                              std::span<const std::uint8_t> rgb, std::span<const Attribute> attributes) {
    assert(width > 0 && height > 0);
    assert(rgb.size() == std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    requirePngSize(name, width, height);
    // Rendered pictures have large flat areas: without row filters they compress twice as fast, to about the same size.
    stbi_write_force_png_filter = 0;
    stbi_write_png_compression_level = 5;
    std::optional<std::vector<std::byte>> file;
    const int written = stbi_write_png_to_func(appendBytes, &file, width, height, 3, rgb.data(), width * 3);
    if (written == 0 || !file) {
        throw Error(ErrorKind::LimitExceeded, fmt::format("'{}': no memory to pack a PNG of {} x {} pixels",
                                                          name.string(), width, height));
    }
    insertTexts(*file, attributes);
    return std::move(*file);
}

struct StbFree {
    void operator()(void *pixels) const { stbi_image_free(pixels); }
};

/// Checks the length of the compressed stream by decompressing it into a buffer of the size in the header. stb_image
/// would grow its buffer as long as the stream continues, and accepts a stream that is too long.
void requireWholeStream(const InputFile &file, const PngChunks &chunks) {
    std::vector<char> rows(static_cast<std::size_t>(chunks.rowDataBytes));
    const auto stream = chunks.compressed();
    const int unpackedBytes = stbi_zlib_decode_buffer(rows.data(), static_cast<int>(rows.size()),
                                                      reinterpret_cast<const char *>(stream.data()),
                                                      static_cast<int>(stream.size()));
    if (unpackedBytes < 0) {
        throw file.bad(fmt::format("its compressed pixels are damaged, or more than {} x {}", chunks.width,
                                   chunks.height));
    }
    if (static_cast<std::uint64_t>(unpackedBytes) != chunks.rowDataBytes) {
        throw file.bad(fmt::format("{} x {} pixels take {} bytes, but it has {}", chunks.width, chunks.height,
                                   chunks.rowDataBytes, unpackedBytes));
    }
}

template <typename Level> using StbLoad = Level *(const stbi_uc *, int, int *, int *, int *, int);

/// Decodes to `channelCount` levels per pixel; `channelCountInFile` is the number of channels in the file.
template <typename Level>
std::unique_ptr<Level, StbFree> decodeLevels(const InputFile &file, const PngChunks &chunks,
                                             StbLoad<Level> *load, int channelCount,
                                             int &channelCountInFile) {
    int width = 0;
    int height = 0;
    std::unique_ptr<Level, StbFree> levels(load(reinterpret_cast<const stbi_uc *>(chunks.minimal.data()),
                                                static_cast<int>(chunks.minimal.size()), &width, &height,
                                                &channelCountInFile, channelCount));
    if (!levels || width != chunks.width || height != chunks.height) {
        const char *reason = stbi_failure_reason();
        throw file.bad(
            fmt::format("its pixels cannot be decoded: {}", reason != nullptr ? reason : "unknown"));
    }
    return levels;
}

template <typename Level>
Image decode(const InputFile &file, const PngChunks &chunks, StbLoad<Level> *load, float levelMax) {
    int channelCountInFile = 0;
    const auto levels = decodeLevels<Level>(file, chunks, load, 3, channelCountInFile);
    Image image(chunks.width, chunks.height);
    const Level *next = levels.get();
    for (glm::vec3 &pixel : image.pixels()) {
        pixel = glm::vec3(next[0], next[1], next[2]) / levelMax;
        next += 3;
    }
    return image;
}

} // namespace

bool isPng(std::span<const std::byte> head) {
    constexpr std::array<unsigned char, 8> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return head.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), head.begin(),
                      [](unsigned char a, std::byte b) { return std::byte{a} == b; });
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

void writePng(AtomicFile &file, int width, int height, std::span<const std::uint8_t> rgb,
              std::span<const Attribute> attributes) {
    file.write(encode(file.path(), width, height, rgb, attributes));
}

std::vector<std::byte> encodePng(int width, int height, std::span<const std::uint8_t> rgb,
                                 std::span<const Attribute> attributes) {
    return encode("the image", width, height, rgb, attributes);
}

Texture readPngTexture(const InputFile &file) {
    const PngChunks chunks = readPngChunks(file);
    requireWholeStream(file, chunks);
    int channelCountInFile = 0;
    const auto levels =
        decodeLevels<stbi_uc>(file, chunks, stbi_load_from_memory, STBI_rgb_alpha, channelCountInFile);
    Texture texture;
    texture.name = file.path().string();
    texture.width = chunks.width;
    texture.height = chunks.height;
    texture.hasAlpha = channelCountInFile == STBI_grey_alpha || channelCountInFile == STBI_rgb_alpha;
    texture.levels.resize(texture.pixelCount());
    const stbi_uc *next = levels.get();
    for (std::uint32_t &pixel : texture.levels) {
        pixel = 0;
        for (unsigned channel = 0; channel < 4; ++channel)
            pixel |= std::uint32_t{next[channel]} << 8u * channel;
        next += 4;
    }
    return texture;
}

Image readPng(const InputFile &file) {
    const PngChunks chunks = readPngChunks(file);
    requireWholeStream(file, chunks);

    return chunks.bitDepth == 16 ? decode(file, chunks, stbi_load_16_from_memory, 65535.0f)
                                 : decode(file, chunks, stbi_load_from_memory, 255.0f);
}

} // namespace hyalite
