// Features of surfaces: what kernels must have code for. What no surface of a scene needs is left out of them.
#pragma once

#include "host/scene/scene.h"

#include <cstdint>

namespace hyalite::core {

/// The one channel of the image in `slot` that is read, as in TextureRecord::format: 0 for all, or for the red one.
[[nodiscard]] std::uint32_t channelOf(const Texture &texture, const TextureUse &use, std::uint32_t slot);

/// Bits of layout::textures... that the material needs.
[[nodiscard]] std::uint32_t texturingOf(const Material &material, const std::vector<Texture> &textures);

/// Bits of layout::textures... that the mesh brings.
[[nodiscard]] std::uint32_t texturingOf(const TriangleMesh &mesh);

/// Whether any vertex is less than opaque by its colour.
[[nodiscard]] bool hasTransparentColours(const TriangleMesh &mesh);

/// Bits of layout::anyHit...: how rays pass through triangles of the material. `hasTransparentColours` is that of their
/// mesh.
[[nodiscard]] std::uint32_t anyHitOf(const Material &material, bool hasTransparentColours);

} // namespace hyalite::core
