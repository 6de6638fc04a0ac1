#include "host/image/flip_kernels.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace hyalite::core {

namespace {

constexpr double pi = std::numbers::pi;

/// The weights of f at the pixels -radius ... +radius.
template <typename Function> std::vector<double> sample(int radius, Function f) {
    std::vector<double> weights;
    for (int i = -radius; i <= radius; ++i)
        weights.push_back(f(static_cast<double>(i)));
    return weights;
}

double sumOf(const std::vector<double> &weights) {
    double sum = 0.0;
    for (const double weight : weights)
        sum += weight;
    return sum;
}

Kernel scaled(const std::vector<double> &weights, double positiveFactor, double negativeFactor) {
    Kernel kernel;
    for (const double weight : weights)
        kernel.push_back(static_cast<float>(weight * (weight < 0.0 ? negativeFactor : positiveFactor)));
    return kernel;
}

Kernel withUnitSum(const std::vector<double> &weights) {
    const double factor = 1.0 / sumOf(weights);
    return scaled(weights, factor, factor);
}

/// Positive weights sum to 1, negative ones to -1.
Kernel balanced(const std::vector<double> &weights) {
    double positiveSum = 0.0;
    double negativeSum = 0.0;
    for (const double weight : weights)
        (weight < 0.0 ? negativeSum : positiveSum) += std::abs(weight);
    return scaled(weights, 1.0 / positiveSum, 1.0 / negativeSum);
}

/// A term a sqrt(pi / b) exp(-pi^2 z / b) of a contrast sensitivity function, z in degrees squared
/// (HPG 2020, table 1 and equation 3).
struct CsfTerm {
    double a;
    double b;
};

constexpr CsfTerm achromaticTerm = {1.0, 0.0047};
constexpr CsfTerm redGreenTerm = {1.0, 0.0053};
constexpr CsfTerm blueYellowTerm1 = {34.1, 0.04};
constexpr CsfTerm blueYellowTerm2 = {13.5, 0.025};

/// The common radius of all terms: three standard deviations of the widest one.
int csfRadius(double pixelsPerDegree) {
    return static_cast<int>(
        std::ceil(3.0 * std::sqrt(blueYellowTerm1.b / (2.0 * pi * pi)) * pixelsPerDegree));
}

std::vector<double> csfGaussian(const CsfTerm &term, double pixelsPerDegree) {
    return sample(csfRadius(pixelsPerDegree), [&](double pixels) {
        const double degrees = pixels / pixelsPerDegree;
        return std::exp(-pi * pi * degrees * degrees / term.b);
    });
}

} // namespace

FlipKernels makeFlipKernels(double pixelsPerDegree) {
    assert(pixelsPerDegree > 0.0);
    FlipKernels kernels;
    kernels.achromatic = withUnitSum(csfGaussian(achromaticTerm, pixelsPerDegree));
    kernels.redGreen = withUnitSum(csfGaussian(redGreenTerm, pixelsPerDegree));

    const std::vector<double> gaussian1 = csfGaussian(blueYellowTerm1, pixelsPerDegree);
    const std::vector<double> gaussian2 = csfGaussian(blueYellowTerm2, pixelsPerDegree);
    const double height1 = blueYellowTerm1.a * std::sqrt(pi / blueYellowTerm1.b);
    const double height2 = blueYellowTerm2.a * std::sqrt(pi / blueYellowTerm2.b);
    const double sum1 = sumOf(gaussian1);
    const double sum2 = sumOf(gaussian2);
    const double total = height1 * sum1 * sum1 + height2 * sum2 * sum2;
    kernels.blueYellow1 = scaled(gaussian1, std::sqrt(height1 / total), 0.0);
    kernels.blueYellow2 = scaled(gaussian2, std::sqrt(height2 / total), 0.0);

    // The peak-to-trough distance of the eye's edge detector is 0.082 degrees: two standard deviations.
    const double deviation = 0.5 * 0.082 * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation));
    const auto bell = [&](double x) { return std::exp(-x * x / (2.0 * deviation * deviation)); };
    kernels.gaussian = withUnitSum(sample(radius, bell));
    kernels.edge = balanced(sample(radius, [&](double x) { return -x * bell(x); }));
    kernels.point =
        balanced(sample(radius, [&](double x) { return (x * x / (deviation * deviation) - 1.0) * bell(x); }));
    return kernels;
}

} // namespace hyalite::core
