// Textures in the layout that the kernels read: the rows of shaders/layout/layout.h.
#pragma once

#include "host/packing/packed_scene.h"

#include <cstdint>
#include <span>

namespace hyalite {

/// Fills packed.textures, and tells the packed materials where theirs are. `order` has the input index of each packed
/// material; the triangles are packed. Nothing is packed where neither packed.texturing nor the integrator asks for it.
/// Images of 8 bits are decoded to floats where all images together take no more than `maxDecoded` bytes so, else
/// texturesLevels is set in packed.texturing.
void packTextures(const Scene &scene, std::span<const std::uint32_t> order, std::size_t maxDecoded,
                  PackedScene &packed);

/// The mean of what a packed material's emission is multiplied with; 1 where it has no texture of emission.
[[nodiscard]] glm::dvec3 meanEmissionFactor(const PackedScene &packed,
                                            const layout::MaterialRecord &material);

} // namespace hyalite
