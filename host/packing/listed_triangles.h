// Few triangles, as kernels test them without a tree: in pairs that share an edge, so that a ray sees four vertices in
// place of six.
#pragma once

#include "shaders/layout/layout.h"

#include <span>
#include <vector>

namespace hyalite::core {

/// Each of `triangles`, which are at most layout::maxListedTriangles, is in one pair, by itself if no other shares an
/// edge with it. Vertices are shared if all their bits are equal.
[[nodiscard]] std::vector<layout::TrianglePair>
pairTriangles(std::span<const layout::TriangleRecord> triangles);

} // namespace hyalite::core
