// Texture library of a scene: each file is loaded once.
#pragma once

#include "host/base/input_file.h"
#include "host/image/texture.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

/// Properties of the pixels of a texture of 8-bit levels. All false for one of floats.
struct TextureLook {
    bool isGrey = false; ///< as height maps are, but not normal maps
    /// Nearly all colours are unit vectors on the side of +z, in the usual encoding.
    bool isNormalMap = false;
    bool hasCutOuts = false; ///< an alpha below a half
};

[[nodiscard]] TextureLook lookAt(const Texture &texture);

class TextureLibrary {
  public:
    /// The index of the file's texture, which is read the first time. Throws Error{BadInput} as readTexture() does,
    /// each time anew, and Error{LimitExceeded} if all textures together take more than limits::textureBytes.
    [[nodiscard]] std::uint32_t load(const std::filesystem::path &file);

    /// The same for an image inside a file: `name`, such as "model.glb#/images/3", is its own alone.
    [[nodiscard]] std::uint32_t load(const std::string &name, std::span<const std::byte> image);

    /// The same for a texture in memory.
    [[nodiscard]] std::uint32_t load(const std::string &name, const Texture &texture);

    [[nodiscard]] const Texture &at(std::uint32_t index) const { return textures_[index]; }

    /// Properties of its pixels, which are computed once.
    [[nodiscard]] const TextureLook &lookOf(std::uint32_t index);

    [[nodiscard]] std::vector<Texture> give() { return std::move(textures_); }

  private:
    std::uint32_t add(const std::string &key, Texture &&texture);

    std::vector<Texture> textures_;
    std::map<std::string, std::uint32_t> indices_; ///< by canonical path, or name
    std::map<std::string, std::string> failures_;  ///< messages of files that cannot be read
    std::vector<std::optional<TextureLook>> looks_;
    std::size_t sizeBytes_ = 0; ///< of all textures, on the device
};

} // namespace hyalite::core
