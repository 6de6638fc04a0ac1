// Split strategies: how a builder divides a range of triangles. Builders differ in nothing else.
#pragma once

#include "host/bvh/wide_box.h"

namespace hyalite::core {

// Each function reorders `range` (at least two triangles) and returns the size of the left child: in [1, size - 1], or
// 0 for no split. No split makes a leaf; a range larger than `leafSize` gets 0 only if centroids do not separate it.

/// Cuts the longest axis of `box`, which encloses the range, at its midpoint and divides triangles by centroid. Returns
/// 0 for `leafSize` triangles or fewer.
[[nodiscard]] std::size_t splitAtMidpoint(std::span<BuildTriangle> range, const Box &box,
                                          std::size_t leafSize);

/// The best cut between at most 16 bins on each axis by the surface area heuristic. Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007. `bounds` are those of the range.
[[nodiscard]] std::size_t splitBySah(std::span<BuildTriangle> range, const RangeBounds &bounds,
                                     std::size_t leafSize);

/// Halves the range by the centroids' order on the longest axis of `box`; ties go by input index.
[[nodiscard]] std::size_t splitAtMedian(std::span<BuildTriangle> range, const Box &box);

/// Costs of the surface area heuristic, relative to each other: visiting an inner node and testing a triangle.
inline constexpr double nodeCost = 1.0;
inline constexpr double triangleCost = 1.0;

} // namespace hyalite::core
