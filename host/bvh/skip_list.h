// The tree as skip lists: the layout of traverse_skip.glsl, packed from the node pairs.
#pragma once

#include "host/bvh/packed_scene.h"

#include <vector>

namespace hyalite {

struct SkipList {
    std::vector<layout::SkipNode>
        nodes; ///< eight lists of `length`, by octant: bit 0 set for directions with x < 0, ...
    std::uint32_t length = 0; ///< of one list, padding included
    glm::vec3 gridOrigin{0.0f};
    glm::vec3 gridScale{1.0f}; ///< > 0; a plane is at gridOrigin + gridScale * q, q in [0, 65535]
};

/// Empty without triangles. Every box of the list encloses the box that it was made from.
[[nodiscard]] SkipList makeSkipList(const PackedScene &scene);

} // namespace hyalite
