// Pixels at which two pictures are further apart than is allowed.
#pragma once

#include "host/image/image.h"
#include "host/image/metrics.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace hyalite {

/// How far two channels may be apart: by so many representable numbers, or by a difference of linear radiance.
struct Tolerance {
    double absolute = 0.0;
    std::uint32_t ulps = 0;

    [[nodiscard]] bool allows(float a, float b) const;
};

/// Of "4ulp" or "1e-5". Throws Error{Usage}.
[[nodiscard]] Tolerance parseTolerance(const std::string &text);

/// Pixels of the images, that is of the crop.
using Pixels = std::vector<glm::ivec2>;

/// By rows. Images are of one size, here and below.
[[nodiscard]] Pixels findOutliers(const Image &a, const Image &b, const Tolerance &tolerance);

/// More than two of 255 levels apart in a PNG: what an eye could find.
[[nodiscard]] Pixels findVisibleOutliers(const Image &a, const Image &b);

/// The pixel that a difference is explained at: the one with the largest, or the first with any.
[[nodiscard]] glm::ivec2 worstPixel(const Image &a, const Image &b, const PixelMetrics &metrics);

} // namespace hyalite
