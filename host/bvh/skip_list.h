// The tree as skip lists: the layout of traverse_skip.glsl, packed from the node pairs.
#pragma once

#include "host/bvh/packed_scene.h"

#include <vector>

namespace hyalite {

struct SkipList {
    std::vector<layout::SkipNode> nodes; ///< `orderCount` lists of `length`
    std::uint32_t orderCount = 8;
    std::uint32_t length = 0; ///< of one list
    glm::vec3 gridOrigin{0.0f};
    glm::vec3 gridScale{1.0f}; ///< > 0; a plane is at gridOrigin + gridScale * q, q in [0, 65535]
};

/// Empty without triangles. Every box of the list encloses the box that it was made from.
///
/// With 8 orders there is a list for each octant of directions (bit 0 set for x < 0, ...), in which nearer siblings come
/// first, and of each two planes the low half holds the one that is met first. A list takes 16 bytes a node; large
/// meshes may want fewer. With 2 orders list 0 is in the order of octant 0 and list 1 in that of octant 7, for
/// directions whose longest component is negative; with 1 there is only list 0. Their low halves hold lower planes: who
/// goes through them must swap those of axes on which the direction is negative.
[[nodiscard]] SkipList makeSkipList(const PackedScene &scene, std::uint32_t orderCount = 8);

} // namespace hyalite
