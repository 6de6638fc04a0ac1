// Textures in the layout that the kernels read: the rows of shaders/layout/layout.h.
#pragma once

#include "host/packing/packed_scene.h"

#include <cstdint>
#include <span>

namespace hyalite::core {

/// Fills packed.textures, and sets the texture positions of the packed materials. `order` has the input index of each
/// packed material. The triangles must be packed. Does nothing unless packed.texturing or anisotropic materials
/// need them. 8-bit images are decoded to floats if all decoded images take at most
/// `maxDecoded` bytes; otherwise texturesLevels is set in packed.texturing.
void packTextures(const Scene &scene, std::span<const std::uint32_t> order, std::size_t maxDecoded,
                  PackedScene &packed);

/// The mean of the emission texture of a packed material; 1 without one.
[[nodiscard]] glm::dvec3 meanEmissionFactor(const PackedScene &packed,
                                            const layout::MaterialRecord &material);

} // namespace hyalite::core
