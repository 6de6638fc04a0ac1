// Texture library of a scene: each file is loaded once.
#pragma once

#include "host/base/input_file.h"
#include "host/image/texture.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hyalite {

class TextureLibrary {
  public:
    /// The index of the file's texture, which is read the first time. Throws Error{BadInput} as readTexture() does, and
    /// if all textures together take more than limits::textureBytes.
    [[nodiscard]] std::uint32_t load(const std::filesystem::path &file);

    /// The same for an image inside a file: `name`, such as "model.glb#/images/3", is its own alone.
    [[nodiscard]] std::uint32_t load(const std::string &name, std::span<const std::byte> image);

    [[nodiscard]] const Texture &at(std::uint32_t index) const { return textures_[index]; }

    [[nodiscard]] std::vector<Texture> give() { return std::move(textures_); }

  private:
    std::uint32_t add(const std::string &key, const InputFile &file);

    std::vector<Texture> textures_;
    std::map<std::string, std::uint32_t> indices_; ///< by canonical path, or name
    std::size_t sizeBytes_ = 0;                    ///< of all textures, on the device
};

/// Whether all 8-bit levels are grey, as in height maps but not in normal maps.
[[nodiscard]] bool isGrey(const Texture &texture);

} // namespace hyalite
