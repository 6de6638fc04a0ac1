// Structural similarity (SSIM) of two images.
#pragma once

#include "host/image/image.h"
#include "host/image/mask.h"

#include <optional>
#include <vector>

namespace hyalite::core {

/// The side of the window that SSIM looks at.
inline constexpr int ssimWindowSide = 11;

/// The mean structural similarity index in [-1, 1]; 1 for equal images. Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli,
/// "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE TIP 13(4), 2004: a Gaussian window
/// of 11 x 11 with sigma 1.5, K1 = 0.01, K2 = 0.03, a range of 1.
///
/// The index is averaged over the windows inside the image and over the channels R, G and B, without any conversion of
/// the numbers. In scikit-image, in double, that is structural_similarity(a, b, data_range=1, channel_axis=2,
/// gaussian_weights=True, sigma=1.5, use_sample_covariance=False).
///
/// With a mask, only windows centred on a compared pixel count, and b equals a outside the mask. Empty if no window
/// counts, as in an image with a side below 11, or if an image holds NaN or infinity.
[[nodiscard]] std::optional<double> meanSsim(const Image &a, const Image &b, const Mask &mask = {});

/// The index of the window around each pixel, averaged over the channels; NaN where the window leaves the image, and
/// where it holds NaN or infinity. Row by row from the top left. Images have the same size.
[[nodiscard]] std::vector<float> ssimMap(const Image &a, const Image &b);

} // namespace hyalite::core
