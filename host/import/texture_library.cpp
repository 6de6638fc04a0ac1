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
    std::string key = std::filesystem::weakly_canonical(file, error).string();
    if (key.empty())
        key = file.string();
    const auto found = indices_.find(key);
    return found != indices_.end() ? found->second : add(key, InputFile(file));
}

std::uint32_t TextureLibrary::load(const std::string &name, std::span<const std::byte> image) {
    const auto found = indices_.find(name);
    return found != indices_.end() ? found->second : add(name, InputFile(name, image));
}

std::uint32_t TextureLibrary::add(const std::string &key, const InputFile &file) {
    Texture texture = readTexture(file);
    const std::size_t sizeBytes = sizeBytes_ + bytesOnDevice(texture);
    if (sizeBytes > limits::textureBytes) // before the next one takes memory
        throw Error(
            ErrorKind::BadInput,
            fmt::format("{}: {} x {} pixels make it {} bytes of textures; allowed: {}; make images smaller",
                        file.path().string(), texture.width, texture.height, sizeBytes,
                        limits::textureBytes));
    sizeBytes_ = sizeBytes;
    const auto index = static_cast<std::uint32_t>(textures_.size());
    textures_.push_back(std::move(texture));
    indices_.emplace(key, index);
    return index;
}

bool isGrey(const Texture &texture) {
    return !texture.isFloat() && std::ranges::all_of(texture.levels, [](std::uint32_t levels) {
        const std::uint32_t red = levels & 255u;
        return red == (levels >> 8u & 255u) && red == (levels >> 16u & 255u);
    });
}

} // namespace hyalite
