// The spheres that are in the tree.
#pragma once

#include "host/scene/scene.h"

#include <cstdint>
#include <vector>

namespace hyalite::core {

/// The indices of the spheres in the tree, in ascending order. Up to layout::maxUnrolledSpheres stay outside and are
/// tested one after the other: all of them in a scene with no more, and otherwise giants, like one that serves as the
/// ground, around which the boxes of all the rest would lose their precision.
[[nodiscard]] std::vector<std::uint32_t> spheresInTree(const Scene &scene);

} // namespace hyalite::core
