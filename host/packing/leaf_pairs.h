// Leaves of two triangles that kernels over skip lists test at once (layout.h: SkipNode).
#pragma once

#include "shaders/layout/layout.h"

#include <cstdint>

namespace hyalite::core {

/// The bits of a leaf's link that say where the common edge of its two triangles is; 0: they are no pair. A pair has
/// ids that follow each other, a material and flags in common except for triangleEndsLeaf and emitters, and an edge
/// that runs through its triangles in opposite directions.
[[nodiscard]] std::uint32_t pairingOf(const layout::TriangleRecord &first,
                                      const layout::TriangleRecord &second);

} // namespace hyalite::core
