// Welch's test of the hypothesis that two renders estimate the same picture: a test for each pixel and channel,
// corrected for their number.
//
// After K. Subr and J. Arvo ("Statistical Hypothesis Testing for Assessing Monte Carlo Estimators", Pacific Graphics
// 2007), and the render tests of Mitsuba (W. Jakob and others).
#pragma once

#include "host/film/film.h"
#include "host/image/image.h"

#include <array>
#include <cstdint>
#include <optional>

namespace hyalite::core {

/// A picture whose pixels are means of samples. All images have the same size.
struct Estimate {
    Image mean;
    Image variance;              ///< of the mean
    std::optional<Image> counts; ///< of samples, in all channels; without it variances count as exact
};

[[nodiscard]] Estimate estimateOf(const Film &film);

struct WelchOptions {
    double significance = 0.01; ///< in (0, 1): maximum probability that any test fails on equal pictures
    int minSampleCount = 16;    ///< pixels with fewer samples are skipped: their t is not Student's
};

struct WelchResult {
    std::uint64_t testCount = 0;     ///< channels of pixels, and three of the whole image
    std::uint64_t untestedCount = 0; ///< channels of pixels without variance or with too few samples
    std::uint64_t failureCount = 0;
    double threshold = 0.0; ///< of |z|, by Sidak's correction for testCount
    double largest = 0.0;   ///< |z| of a pixel; infinite if only one side is finite
    int x = 0;              ///< position of the largest
    int y = 0;
    int channel = 0;
    std::array<double, 3> ofImage{}; ///< z of the means over all tested pixels, per channel

    [[nodiscard]] bool isPassed() const { return failureCount == 0; }
};

/// Welch's t of each channel of each pixel, with degrees of freedom by Satterthwaite, converted to the normal deviate
/// of the same probability. 2^-24 of the squared mean is added to each variance: a film of float32 cannot resolve less,
/// and deterministic pixels have a variance of 0. If samples are stratified, tests fail less often than `significance`
/// allows. A test fails if the mean is finite on only one side. Both estimates have the same size.
[[nodiscard]] WelchResult welchTest(const Estimate &a, const Estimate &b, const WelchOptions &options = {});

/// The normal deviate with the same tail probability as `t` of Student's distribution, to 0.5 % from 15 degrees of
/// freedom on (D. L. Wallace, "Bounds on Normal Approximations to Student's and the Chi-Square Distributions", 1959).
[[nodiscard]] double normalDeviateOfStudent(double t, double degreesOfFreedom);

/// |z| that the largest of `testCount` independent normal deviates exceeds with a probability of `significance`
/// (Z. Sidak, "Rectangular Confidence Regions for the Means of Multivariate Normal Distributions", 1967).
[[nodiscard]] double sidakThreshold(double significance, std::uint64_t testCount);

} // namespace hyalite::core
