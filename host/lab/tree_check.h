// Check of a tree: the same rays through it and by brute force.
#pragma once

#include "host/engine/prepare.h"

#include <cstddef>

namespace hyalite::core {

struct TreeCheck {
    int rayCount = 0;
    double treeSeconds = 0.0; ///< of all rays, on one thread of the reference renderer
    double bruteSeconds = 0.0;
    std::size_t differenceCount = 0; ///< rays whose hits differ
    bool hasTree = false;            ///< without one both are the same
};

/// Traces primary rays spread over the image, each through the tree and against all triangles. The source of the scene
/// was kept.
[[nodiscard]] TreeCheck checkTree(const PreparedScene &prepared, int rayCount);

} // namespace hyalite::core
