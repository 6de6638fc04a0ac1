// Per-pixel difference metrics of two images.
#pragma once

#include "host/image/image.h"
#include "host/image/mask.h"

#include <cstdint>

namespace hyalite::core {

/// The differences b - a over the compared pixels. Two channels with the same bits differ by 0, even if both are NaN.
/// Otherwise, if either is NaN or infinite, the difference is infinite.
struct PixelMetrics {
    std::uint64_t pixelCount = 0;          ///< compared
    std::uint64_t differingPixelCount = 0; ///< with any bit different, the sign of zero included
    std::uint64_t outlierCount = 0;        ///< with a channel whose |b - a| is greater than the threshold
    std::uint64_t nonFiniteCount = 0;      ///< with a NaN or an infinity in a or b

    double meanSquaredError = 0.0;       ///< over all channels
    double meanAbsoluteDifference = 0.0; ///< over all channels
    double meanDifference = 0.0;         ///< over all channels: the bias; NaN where a difference is infinite
    double maxAbsoluteDifference = 0.0;
    int worstX = 0; ///< the first pixel with the largest difference; (0, 0) where there is none
    int worstY = 0;

    /// Steps between neighbouring floats, -0 and +0 being one step apart: 0 exactly where all bits are equal.
    std::uint32_t maxUlpDistance = 0;

    /// Peak signal-to-noise ratio in dB for a peak of 1: -10 log10 of the mean squared error. Infinite for no error,
    /// minus infinity for an infinite one.
    [[nodiscard]] double psnrDecibels() const;

    [[nodiscard]] double outlierFraction() const {
        return static_cast<double>(outlierCount) / static_cast<double>(pixelCount);
    }
    [[nodiscard]] bool identical() const { return differingPixelCount == 0; }
};

/// Compares images of one size, of which at least one pixel is compared. The numbers are taken as they are: the peak of
/// 1 fits display-encoded ones, and is a convention for linear ones. Sums are in double, in the order of pixels.
[[nodiscard]] PixelMetrics comparePixels(const Image &a, const Image &b, double outlierThreshold = 0.0,
                                         const Mask &mask = {});

/// The number of steps between neighbouring floats from a to b, on the number line -NaN, -inf, ..., -0, +0, ..., +inf,
/// +NaN.
[[nodiscard]] std::uint32_t ulpDistance(float a, float b);

} // namespace hyalite::core
