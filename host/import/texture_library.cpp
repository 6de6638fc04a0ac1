#include "host/import/texture_library.h"

#include "host/base/error.h"
#include "host/image/texture_file.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <system_error>
#include <utility>

namespace hyalite::core {

std::uint32_t TextureLibrary::load(const std::filesystem::path &file) {
    std::error_code error; // a path without a canonical form is its own key
    std::string key = std::filesystem::weakly_canonical(file, error).string();
    if (key.empty())
        key = file.string();
    if (const auto known = indices_.find(key); known != indices_.end())
        return known->second;
    if (const auto failure = failures_.find(key); failure != failures_.end())
        throw Error(ErrorKind::BadInput, failure->second);
    try {
        return add(key, readTexture(InputFile(file)));
    } catch (const Error &damage) {
        if (damage.kind == ErrorKind::BadInput)
            failures_.emplace(key, damage.what());
        throw;
    }
}

std::uint32_t TextureLibrary::load(const std::string &name, std::span<const std::byte> image) {
    const auto known = indices_.find(name);
    return known != indices_.end() ? known->second : add(name, readTexture(InputFile(name, image)));
}

std::uint32_t TextureLibrary::load(const std::string &name, const Texture &texture) {
    const auto known = indices_.find(name);
    return known != indices_.end() ? known->second : add(name, Texture(texture));
}

std::uint32_t TextureLibrary::add(const std::string &key, Texture &&texture) {
    const std::size_t sizeBytes = sizeBytes_ + bytesOnDevice(texture);
    if (sizeBytes > limits::textureBytes) // before the next one takes memory
        throw Error(
            ErrorKind::LimitExceeded,
            fmt::format("{}: {} x {} pixels make it {} bytes of textures; allowed: {}; make images smaller",
                        texture.name, texture.width, texture.height, sizeBytes, limits::textureBytes));
    sizeBytes_ = sizeBytes;
    const auto index = static_cast<std::uint32_t>(textures_.size());
    textures_.push_back(std::move(texture));
    indices_.emplace(key, index);
    return index;
}

const TextureLook &TextureLibrary::lookOf(std::uint32_t index) {
    looks_.resize(textures_.size());
    std::optional<TextureLook> &look = looks_[index];
    if (!look)
        look = lookAt(textures_[index]);
    return *look;
}

TextureLook lookAt(const Texture &texture) {
    if (texture.isFloat())
        return {};
    TextureLook look{.isGrey = true};
    std::size_t normalCount = 0;
    for (const std::uint32_t levels : texture.levels) {
        const std::uint32_t red = levels & 255u;
        const std::uint32_t green = levels >> 8u & 255u;
        const std::uint32_t blue = levels >> 16u & 255u;
        look.isGrey = look.isGrey && red == green && red == blue;
        look.hasCutOuts = look.hasCutOuts || levels >> 24u < 128;
        const glm::ivec3 normal(2 * static_cast<int>(red) - 255, 2 * static_cast<int>(green) - 255,
                                2 * static_cast<int>(blue) - 255);
        const int squared = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
        constexpr int one = 255 * 255;
        normalCount += normal.z > 0 && squared > one / 2 && squared < one * 3 / 2;
    }
    constexpr double mostOfThem = 0.95;
    look.isNormalMap = !look.isGrey && static_cast<double>(normalCount) >=
                                           mostOfThem * static_cast<double>(texture.levels.size());
    return look;
}

} // namespace hyalite::core
