// The boxes of all primitives, for ray queries (shaders/trace/ray_query.glsl): the device makes a tree of them.
#pragma once

#include "host/packing/packed_scene.h"

#include <cstdint>
#include <vector>

namespace hyalite::core {

struct PrimitiveBoxes {
    std::vector<Box>
        boxes; ///< in the order of the triangle records: of the scene's own tree, then of each instance
    std::vector<std::uint32_t> counts; ///< likewise, of each of these
    /// In place of those of the scene: with the records of their meshes.
    std::vector<layout::InstanceRecord> instances;
};

/// How many boxes there are.
[[nodiscard]] std::uint64_t countPrimitiveBoxes(const PackedScene &scene);

/// Instances are placed: their boxes are around the triangles as kernels place them. All are wider than those by
/// queryBoxPad (shaders/geometry/box.glsl), and by 4 units of rounding of their coordinates.
[[nodiscard]] PrimitiveBoxes makePrimitiveBoxes(const PackedScene &scene);

} // namespace hyalite::core
