// Textures of a glTF file (glTF 2.0, section 3.8; KHR_texture_transform; EXT_texture_webp).
#pragma once

#include "host/import/gltf/buffers.h"
#include "host/import/texture_library.h"
#include "host/scene/material.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core::gltf {

/// The use of a texture with this transform in the convention of scenes, v = 0 at the bottom: `scale`, `shear` and
/// `offset`. glTF's own transform is about v = 0 at the top (KHR_texture_transform).
struct UvTransform {
    glm::dvec2 offset{0.0};
    double rotation = 0.0; ///< radians
    glm::dvec2 scale{1.0};
};
void place(TextureUse &use, const UvTransform &transform);

class TextureReader {
  public:
    /// All outlive the object.
    TextureReader(Buffers &buffers, const FileAccess &access, TextureLibrary &library)
        : buffers_(buffers), access_(access), library_(library) {}

    /// The texture of a textureInfo object, such as "baseColorTexture". Nothing, and a warning, for an image that is
    /// missing, damaged or of a format that is not read. Throws Error{BadInput} for a malformed document.
    [[nodiscard]] std::optional<TextureUse> read(const JsonNode &textureInfo);

    /// The index in the library of the image that `reference` names, of 8-bit levels. Nothing, and a warning, as above.
    [[nodiscard]] std::optional<std::uint32_t> readImage(const JsonNode &reference) {
        return image(buffers_.document().reference(reference, "images"));
    }

    [[nodiscard]] bool hasAlpha(const TextureUse &use) const {
        return library_.at(use.textureIndex).hasAlpha;
    }

  private:
    [[nodiscard]] Losses &losses() const { return buffers_.document().losses(); }
    std::optional<std::uint32_t> image(std::size_t index);
    std::uint32_t load(const JsonNode &node, const JsonObject &object, const std::string &name);

    Buffers &buffers_;
    const FileAccess &access_;
    TextureLibrary &library_;
    std::map<std::size_t, std::optional<std::uint32_t>> images_; ///< those that were asked for
};

} // namespace hyalite::core::gltf
