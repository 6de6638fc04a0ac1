// BVH statistics (depth, leaf sizes, SAH cost) and a validity check.
#pragma once

#include "host/bvh/bvh.h"

#include <array>
#include <string>

namespace hyalite::core {

struct BvhStatistics {
    std::size_t triangleCount = 0;
    std::size_t innerCount = 0;
    std::size_t leafCount = 0;
    int depth = 0;
    std::size_t largestLeaf = 0;
    double meanLeaf = 0.0; ///< triangles
    double sahCost = 0.0;  ///< expected node visits + triangle tests of a random line through the root box
    double trianglesTested = 0.0; ///< the part of sahCost from triangle tests
    /// Leaves with up to 1, 2, 4, 8, 16, 32, 64 and more triangles.
    std::array<std::size_t, 8> leafHistogram{};
};

[[nodiscard]] BvhStatistics measureBvh(const Bvh &bvh);

/// Checks that every triangle except `droppedCount` of them is in exactly one leaf, that every box encloses its
/// subtree, and that the depth is right. Returns the first violation in words, or an empty string.
[[nodiscard]] std::string findBvhFault(const Bvh &bvh, const std::vector<BuildTriangle> &triangles,
                                       std::size_t droppedCount = 0);

} // namespace hyalite::core
