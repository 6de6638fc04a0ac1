#include "host/import/texture_library.h"

#include "host/base/error.h"
#include "host/image/texture_file.h"
#include "host/scene/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace hyalite {

std::uint32_t TextureLibrary::load(const std::filesystem::path &file) {
    std::error_code error; // a path without a canonical form is its own key
    const std::string key = std::filesystem::weakly_canonical(file, error).string();
    const auto index = static_cast<std::uint32_t>(textures_.size());
    const auto [found, isNew] = indices_.try_emplace(key.empty() ? file.string() : key, index);
    if (!isNew)
        return found->second;
    textures_.push_back(readTexture(file));
    sizeBytes_ += bytesOnDevice(textures_.back());
    if (sizeBytes_ > limits::textureBytes) // before the next one takes memory
        throw Error(
            ErrorKind::BadInput,
            fmt::format("{}: {} x {} pixels make it {} bytes of textures; allowed: {}; make images smaller",
                        file.string(), textures_.back().width, textures_.back().height, sizeBytes_,
                        limits::textureBytes));
    return index;
}

bool isGrey(const Texture &texture) {
    return !texture.isFloat() && std::ranges::all_of(texture.levels, [](std::uint32_t levels) {
        const std::uint32_t red = levels & 255u;
        return red == (levels >> 8u & 255u) && red == (levels >> 16u & 255u);
    });
}

} // namespace hyalite
