// FLIP: the difference that an observer sees who flips between two pictures.
//
//   LDR: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A Difference
//        Evaluator for Alternating Images", HPG 2020.
//   HDR: P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moeller, "Visualizing Errors in Rendered High Dynamic
//        Range Images", Eurographics 2021 (short papers).
//
// Errors are in [0, 1]. That between black and white is about 0.97; that between pure green and pure blue, the most
// distant pair of colours, is 1.
#pragma once

#include "host/image/error_map.h"
#include "host/image/image.h"
#include "host/image/mask.h"

namespace hyalite::core {

/// A 0.7 m wide screen of 3840 pixels, looked at from 0.7 m (HPG 2020): 3840 pi / 180.
inline constexpr double flipPixelsPerDegree = 67.0206432765823;

/// LDR-FLIP of display-encoded images of one size, which are taken as sRGB and clamped to [0, 1], NaN to 0.
[[nodiscard]] ErrorMap flipDisplay(const Image &reference, const Image &test,
                                   double pixelsPerDegree = flipPixelsPerDegree);

/// The exposures under which HDR-FLIP looks at the images, evenly spaced from the first to the last.
struct FlipExposures {
    double startStops = 0.0; ///< shows the brightest pixel of the reference at 0.85 of white
    double stopStops = 0.0;  ///< shows the median pixel of the reference at 0.85 of white
    int count = 1;           ///< about one a stop
};

/// Eurographics 2021, section 2.1, for the ACES tone mapper. The published rule divides by the median luminance; if
/// that is 0, the median of the positive luminances is used. Infinite pixels are ignored. A black reference has a
/// single exposure of 0.
[[nodiscard]] FlipExposures flipExposures(const Image &reference);

/// HDR-FLIP of linear images of one size: the largest error of each pixel under all exposures. Values below 0 and
/// NaN are taken as 0; but where one image has a NaN in a pixel and the other has not, the error is 1.
[[nodiscard]] ErrorMap flipLinear(const Image &reference, const Image &test, const FlipExposures &exposures,
                                  double pixelsPerDegree = flipPixelsPerDegree);

/// The errors of the compared pixels, pooled.
struct FlipSummary {
    double mean = 0.0;
    double weightedMedian = 0.0; ///< half of the sum of all errors is in pixels with at most this error
    double max = 0.0;
};

/// At least one pixel is compared.
[[nodiscard]] FlipSummary summarizeFlip(const ErrorMap &map, const Mask &mask = {});

} // namespace hyalite::core
