// Texture library of a scene: each file is loaded once.
#pragma once

#include "host/image/texture.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyalite {

class TextureLibrary {
  public:
    /// The index of the file's texture, which is read the first time. Throws Error{BadInput} as readTexture() does, and
    /// if all textures together take more than limits::textureBytes.
    [[nodiscard]] std::uint32_t load(const std::filesystem::path &file);

    [[nodiscard]] const Texture &at(std::uint32_t index) const { return textures_[index]; }

    [[nodiscard]] std::vector<Texture> give() { return std::move(textures_); }

  private:
    std::vector<Texture> textures_;
    std::map<std::string, std::uint32_t> indices_; ///< by canonical path
    std::size_t sizeBytes_ = 0;                    ///< of all textures, on the device
};

/// Whether all 8-bit levels are grey, as in height maps but not in normal maps.
[[nodiscard]] bool isGrey(const Texture &texture);

} // namespace hyalite
