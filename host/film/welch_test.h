// Whether two renders can be estimates of one picture: a test for each pixel and channel, corrected for their number.
//
// As K. Subr and J. Arvo did ("Statistical Hypothesis Testing for Assessing Monte Carlo Estimators", Pacific Graphics
// 2007), and the render tests of Mitsuba do (W. Jakob and others).
#pragma once

#include "host/film/film.h"
#include "host/image/image.h"

#include <array>
#include <cstdint>
#include <optional>

namespace hyalite {

/// A picture whose pixels are means of samples. All images have one size.
struct Estimate {
    Image mean;
    Image variance;              ///< of the mean
    std::optional<Image> counts; ///< of samples, in all channels; without it variances are taken for exact
};

[[nodiscard]] Estimate estimateOf(const Film &film);

struct WelchOptions {
    double significance = 0.01; ///< in (0, 1): how often all tests together fail on equal pictures, at most
    int leastSampleCount = 16;  ///< pixels of fewer are left out: their t is far from Student's
};

struct WelchResult {
    std::uint64_t testCount = 0;     ///< of channels of pixels, and three of the whole image
    std::uint64_t untestedCount = 0; ///< channels of pixels that have no variance, or too few samples
    std::uint64_t failureCount = 0;
    double threshold = 0.0; ///< of |z|, by Sidak's correction for testCount
    double largest = 0.0;   ///< |z| of pixels; infinite where one side alone is finite
    int x = 0;              ///< where that is
    int y = 0;
    int channel = 0;
    std::array<double, 3> ofImage{}; ///< z of the means over all pixels that are tested, per channel

    [[nodiscard]] bool isPassed() const { return failureCount == 0; }
};

/// Welch's t of each channel of each pixel, with the degrees of freedom by Satterthwaite, as the normal deviate that is
/// as unlikely. A deterministic pixel has a variance of 0: to each variance 2^-24 of the square of the mean is added,
/// which is what a film of float32 cannot resolve. Samples within a pixel may be better spread than independent ones:
/// then fewer tests fail than may. Where the mean is finite on one side alone, the test fails. Both estimates are of
/// one size.
[[nodiscard]] WelchResult welchTest(const Estimate &a, const Estimate &b, const WelchOptions &options = {});

/// The normal deviate that is exceeded as often as `t` of Student's distribution, to 0.5 % from 15 degrees of freedom on
/// (D. L. Wallace, "Bounds on Normal Approximations to Student's and the Chi-Square Distributions", 1959).
[[nodiscard]] double normalDeviateOfStudent(double t, double degreesOfFreedom);

/// |z| that the largest of `testCount` independent normal deviates exceeds with a probability of `significance`
/// (Z. Sidak, "Rectangular Confidence Regions for the Means of Multivariate Normal Distributions", 1967).
[[nodiscard]] double sidakThreshold(double significance, std::uint64_t testCount);

} // namespace hyalite
