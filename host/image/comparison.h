// Comparison of two images by every metric.
#pragma once

#include "host/image/alpha.h"
#include "host/image/error_map.h"
#include "host/image/flip.h"
#include "host/image/image.h"
#include "host/image/image_file.h"
#include "host/image/mask.h"
#include "host/image/metrics.h"

#include <optional>

namespace hyalite::core {

struct ImageComparison {
    Encoding encoding = Encoding::Display; ///< of the compared numbers
    PixelMetrics pixels;
    std::optional<double> ssim; ///< empty if SSIM has no window, see meanSsim()
    FlipSummary flip;           ///< LDR-FLIP of display-encoded images, HDR-FLIP of linear ones
    std::optional<FlipExposures> flipExposures; ///< of HDR-FLIP
    ErrorMap flipMap;                           ///< 0 for pixels outside the mask
    std::optional<AlphaMetrics> alpha{};        ///< if an image has alpha

    [[nodiscard]] bool identical() const { return pixels.identical() && (!alpha || alpha->identical()); }
};

/// Compares images of the same size and encoding, with at least one pixel in the mask. Metrics over neighbourhoods
/// treat the test image as equal to the reference outside the mask.
[[nodiscard]] ImageComparison compareImages(const Image &reference, const Image &test, Encoding encoding,
                                            double outlierThreshold = 0.0, const Mask &mask = {});

/// The same of images with alpha: of their colours over black, and of alpha.
[[nodiscard]] ImageComparison compareImages(const LoadedImage &reference, const LoadedImage &test,
                                            double outlierThreshold = 0.0, const Mask &mask = {});

} // namespace hyalite::core
