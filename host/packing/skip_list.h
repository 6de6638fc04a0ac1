// The BVH as skip lists for traverse_skip.glsl, packed from the node pairs.
#pragma once

#include "host/packing/packed_scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyalite {

struct SkipList {
    std::vector<layout::SkipNode>
        nodes;                ///< two lists of `length`, and a node for rays that have reached the end
    std::uint32_t length = 0; ///< of one list
    glm::vec3 gridMiddle{0.0f};
    glm::vec3 gridScale{1.0f}; ///< > 0; a plane is at gridMiddle + gridScale * q, q in [-32768, 32767]
};

/// Empty without triangles. Every box of the list encloses the box from which it was made.
///
/// In the first list lower siblings come first, for rays with a positive largest direction component; in the second
/// list upper siblings do. A list for each octant of directions would save diffuse rays 3 % of their steps, but costs
/// more than that, because less of eight lists fits into caches.
[[nodiscard]] SkipList makeSkipList(const PackedScene &scene);

/// Maximum size of both lists for this many node pairs, in bytes.
[[nodiscard]] std::uint64_t maxSkipListBytes(std::size_t pairCount);
/// Size of the temporary memory for making them, in bytes.
[[nodiscard]] std::uint64_t skipListWorkBytes(std::size_t pairCount);

} // namespace hyalite
