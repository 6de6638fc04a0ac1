// Two images compared by every metric at once.
#pragma once

#include "host/image/error_map.h"
#include "host/image/flip.h"
#include "host/image/image.h"
#include "host/image/image_file.h"
#include "host/image/mask.h"
#include "host/image/metrics.h"

#include <optional>

namespace hyalite {

struct ImageComparison {
    Encoding encoding = Encoding::Display; ///< of the numbers that were compared
    PixelMetrics pixels;
    std::optional<double> ssim; ///< nothing where SSIM has no window, see meanSsim()
    FlipSummary flip;           ///< LDR-FLIP of display-encoded images, HDR-FLIP of linear ones
    std::optional<FlipExposures> flipExposures; ///< of HDR-FLIP
    ErrorMap flipMap;                           ///< 0 for pixels that are not compared
};

/// Compares images of one size and one encoding, of which `reference` is the one that is right if one of them is.
/// At least one pixel is compared. Where the mask leaves pixels out, the metrics that look at neighbourhoods take the
/// test image to be equal to the reference there.
[[nodiscard]] ImageComparison compareImages(const Image &reference, const Image &test, Encoding encoding,
                                            double outlierThreshold = 0.0, const Mask &mask = {});

} // namespace hyalite
