// Outliers: pixels at which two pictures differ by more than allowed.
#pragma once

#include "host/image/image.h"
#include "host/image/metrics.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::core {

/// Tolerance between two channels: in ulps, or as a difference of linear radiance.
struct Tolerance {
    double absolute = 0.0;
    std::uint32_t ulps = 0;

    [[nodiscard]] bool allows(float a, float b) const;
};

/// Parses "4ulp" or "1e-5". Throws Error{Usage}.
[[nodiscard]] Tolerance parseTolerance(const std::string &text);

/// Outliers, as pixels of the crop.
using Pixels = std::vector<glm::ivec2>;

/// In row order. Images have the same size, here and below.
[[nodiscard]] Pixels findOutliers(const Image &a, const Image &b, const Tolerance &tolerance);

/// Pixels that differ by more than two of 255 levels in a PNG: visible differences.
[[nodiscard]] Pixels findVisibleOutliers(const Image &a, const Image &b);

} // namespace hyalite::core
