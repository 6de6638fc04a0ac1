// How a builder divides a range of triangles: the only thing in which builders differ.
#pragma once

#include "host/bvh/wide_box.h"

namespace hyalite {

// Each reorders `range` (at least two triangles) and returns how many go to the left child: in [1, size - 1], or 0 to
// leave the range whole: as a leaf, or, of more than `leafSize`, as one that centroids do not separate.

/// The longest axis of `box`, which encloses the range, is cut at its midpoint and triangles go by their centroids, until
/// `leafSize` or fewer remain.
[[nodiscard]] std::size_t splitAtMidpoint(std::span<BuildTriangle> range, const Box &box,
                                          std::size_t leafSize);

/// The best cut between at most 16 bins on each axis by the surface area heuristic. Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007. `bounds` are those of the range.
[[nodiscard]] std::size_t splitBySah(std::span<BuildTriangle> range, const Bounds &bounds,
                                     std::size_t leafSize);

/// Halves the range by the centroids' order on the longest axis of `box`; ties go by input index.
[[nodiscard]] std::size_t splitAtMedian(std::span<BuildTriangle> range, const Box &box);

/// Costs of the surface area heuristic, relative to each other: visiting an inner node and testing a triangle.
inline constexpr double nodeCost = 1.0;
inline constexpr double triangleCost = 1.0;

} // namespace hyalite
