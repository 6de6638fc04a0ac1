#include "host/image/webp.h"

#include "host/image/image_limits.h"

#include <fmt/format.h>
#include <webp/decode.h>

#include <algorithm>
#include <bit>
#include <string_view>
#include <vector>

namespace hyalite::core {

namespace {

static_assert(std::endian::native == std::endian::little, "red is written to the lowest byte");

bool hasWordAt(std::span<const std::byte> bytes, std::size_t offset, std::string_view word) {
    return bytes.size() >= offset + word.size() &&
           std::ranges::equal(bytes.subspan(offset, word.size()), std::as_bytes(std::span(word)));
}

} // namespace

bool isWebp(std::span<const std::byte> head) {
    return hasWordAt(head, 0, "RIFF") && hasWordAt(head, 8, "WEBP");
}

Texture readWebp(const InputFile &file) {
    constexpr std::uint64_t fileBytesMax = std::uint64_t{1} << 30;
    if (file.sizeBytes() > fileBytesMax)
        throw file.bad(fmt::format("it has {} bytes; allowed: at most {}", file.sizeBytes(), fileBytesMax));
    const std::vector<std::byte> bytes = file.head(static_cast<std::size_t>(file.sizeBytes()));
    const auto *const data = reinterpret_cast<const std::uint8_t *>(bytes.data());
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
        throw file.bad("it is damaged: its header cannot be read");
    if (features.has_animation != 0)
        throw file.bad("it is an animation; allowed: a still picture");
    requireImageSize(file, features.width, features.height);
    Texture texture;
    texture.name = file.path().string();
    texture.width = features.width;
    texture.height = features.height;
    texture.hasAlpha = features.has_alpha != 0;
    constexpr std::uint64_t besideLevels = 3; // decoded planes and tables, of the size of the levels
    requireReadingMemory(file, static_cast<std::uint64_t>(features.width),
                         static_cast<std::uint64_t>(features.height),
                         besideLevels * texture.pixelCount() * sizeof(std::uint32_t) + file.sizeBytes());
    texture.levels.resize(texture.pixelCount());
    if (WebPDecodeRGBAInto(data, bytes.size(), reinterpret_cast<std::uint8_t *>(texture.levels.data()),
                           texture.levels.size() * sizeof(std::uint32_t), 4 * features.width) == nullptr)
        throw file.bad("it is damaged: its pixels cannot be decoded");
    return texture;
}

} // namespace hyalite::core
