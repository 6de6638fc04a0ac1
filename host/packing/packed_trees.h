// The triangles, nodes and instances of a packed scene.
#pragma once

#include "host/packing/packed_scene.h"

#include <cstdint>
#include <span>

namespace hyalite::core {

/// Fills the arrays of triangles, normals and instances, the nodes and `trees`. `bvh` was built from the scene, and
/// `packedMaterial` has the index of a material's record by its index in the input.
void packTrees(const Scene &scene, const Bvh &bvh, std::span<const std::uint32_t> packedMaterial,
               PackedScene &packed);

} // namespace hyalite::core
