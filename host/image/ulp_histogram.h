// Histogram of differences in ULPs.
#pragma once

#include "host/image/image.h"
#include "host/image/mask.h"

#include <array>
#include <cstdint>
#include <span>

namespace hyalite::core {

/// Counts of values by ulpDistance(): 0, 1, 2 to 3, 4 to 7 and so on: in bin i > 0 from 2^(i-1) on.
using UlpHistogram = std::array<std::uint64_t, 33>;

/// Of the compared values of two images of one size.
[[nodiscard]] UlpHistogram ulpHistogram(const Image &a, const Image &b, const Mask &mask = {});
/// Adds those of alpha. Empty: opaque.
void addAlphaUlps(UlpHistogram &histogram, std::span<const float> a, std::span<const float> b,
                  const Mask &mask = {});

} // namespace hyalite::core
