// Cameras of the plain path tracer.
#pragma once

#include "host/scene/settings.h"
#include "tests/images/plain_geometry.h"

namespace hyalite::core::testing::plain {

struct Ray {
    Vec origin;
    Vec direction; ///< unit length
};

/// Through the image position (x, y) in pixels, y down; through a random point of the lens, where there is one.
[[nodiscard]] Ray primaryRay(const Camera &camera, double x, double y, Generator &generator);

/// An offset from the middle of a pixel, in pixels, distributed as the filter is high.
[[nodiscard]] Vec2 randomOffset(FilterKind filter, Generator &generator);

} // namespace hyalite::core::testing::plain
