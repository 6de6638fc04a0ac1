// The BVH as skip lists for traverse_skip.glsl, packed from the node pairs.
#pragma once

#include "host/packing/packed_scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyalite {

struct SkipList {
    std::vector<layout::SkipNode> nodes; ///< two lists of `length`, and one that rays at the end read
    std::uint32_t length = 0;            ///< of one list
    glm::vec3 gridMiddle{0.0f};
    glm::vec3 gridScale{1.0f}; ///< > 0; a plane is at gridMiddle + gridScale * q, q in [-32768, 32767]
};

/// Empty without triangles. Every box of the list encloses the box that it was made from.
///
/// In the first list lower siblings come first, for rays whose direction's longest component is positive, in the second
/// one upper ones. A list for each octant of directions would save diffuse rays 3 % of their steps, and cost more than
/// that: caches hold less of eight lists.
[[nodiscard]] SkipList makeSkipList(const PackedScene &scene);

/// The bytes of both lists of so many node pairs, at most, and of what making them takes beside.
[[nodiscard]] std::uint64_t mostSkipListBytes(std::size_t pairCount);
[[nodiscard]] std::uint64_t skipListWorkBytes(std::size_t pairCount);

} // namespace hyalite
