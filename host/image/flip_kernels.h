// The filters of FLIP, as one-dimensional kernels.
//
// Every filter is a product of a function of x and one of y, or a sum of two such products, and so is applied as a
// pass over columns and a pass over rows.
#pragma once

#include <vector>

namespace hyalite::core {

/// Weights for the pixels -radius ... +radius.
using Kernel = std::vector<float>;

struct FlipKernels {
    // Contrast sensitivity (HPG 2020, section 4.1.1): Gaussians that sum to 1. The blue-yellow filter is the sum
    // of two, w1 G1(x) G1(y) + w2 G2(x) G2(y); each of its kernels holds the square root of its weight.
    Kernel achromatic;
    Kernel redGreen;
    Kernel blueYellow1;
    Kernel blueYellow2;

    // Features (section 4.2.1): a Gaussian that sums to 1, and its first and second derivatives, whose positive
    // weights sum to 1 and whose negative ones to -1.
    Kernel gaussian;
    Kernel edge;
    Kernel point;
};

/// `pixelsPerDegree` is positive.
[[nodiscard]] FlipKernels makeFlipKernels(double pixelsPerDegree);

} // namespace hyalite::core
