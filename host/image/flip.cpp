#include "host/image/flip.h"

#include "host/image/flip_opponent.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace hyalite::core {

namespace {

/// The ACES curve of K. Narkowicz, (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5), with its exposure of 0.6 taken into the
/// constants (Eurographics 2021, section 2).
constexpr double k0 = 0.6 * 0.6 * 2.51;
constexpr double k1 = 0.6 * 0.03;
constexpr double k3 = 0.6 * 0.6 * 2.43;
constexpr double k4 = 0.6 * 0.59;
constexpr double k5 = 0.14;

/// In [0, 1]; 0 for NaN.
float toneMapAces(float linear, double scale) {
    if (!(linear > 0.0f))
        return 0.0f;
    const double exposed = static_cast<double>(linear) * scale;
    if (exposed > 1e6) // the curve exceeds 1 here, and its terms would overflow for far larger values
        return 1.0f;
    const auto x = static_cast<float>(exposed);
    return clampToUnit(x * (static_cast<float>(k0) * x + static_cast<float>(k1)) /
                       (x * (static_cast<float>(k3) * x + static_cast<float>(k4)) + static_cast<float>(k5)));
}

/// The x that the curve maps to 0.85: the positive root of (k0 - 0.85 k3) x^2 + (k1 - 0.85 k4) x - 0.85 k5.
double exposureTarget() {
    constexpr double target = 0.85;
    constexpr double a = k0 - target * k3;
    constexpr double b = k1 - target * k4;
    constexpr double c = -target * k5;
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

double luminanceOf(const glm::vec3 &linear) {
    const auto positive = [](float value) { return value > 0.0f ? static_cast<double>(value) : 0.0; };
    return 0.2126 * positive(linear.x) + 0.7152 * positive(linear.y) + 0.0722 * positive(linear.z);
}

/// The median; of two middle values the upper one.
double medianOf(std::vector<double> &values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

bool hasNan(const glm::vec3 &pixel) {
    return std::isnan(pixel.x) || std::isnan(pixel.y) || std::isnan(pixel.z);
}

} // namespace

ErrorMap flipDisplay(const Image &reference, const Image &test, double pixelsPerDegree) {
    assert(reference.width() == test.width() && reference.height() == test.height());
    const auto toLinear = [](const glm::vec3 &c) {
        return glm::vec3(linearFromSrgb(clampToUnit(c.x)), linearFromSrgb(clampToUnit(c.y)),
                         linearFromSrgb(clampToUnit(c.z)));
    };
    OpponentPlanes referencePlanes(reference.width(), reference.height());
    OpponentPlanes testPlanes(test.width(), test.height());
    referencePlanes.fill(reference, toLinear);
    testPlanes.fill(test, toLinear);
    return flipOfOpponents(referencePlanes, testPlanes, makeFlipKernels(pixelsPerDegree));
}

FlipExposures flipExposures(const Image &reference) {
    std::vector<double> luminances;
    luminances.reserve(reference.pixels().size());
    for (const glm::vec3 &pixel : reference.pixels()) {
        const double luminance = luminanceOf(pixel);
        if (std::isfinite(luminance)) // infinities are white at any exposure
            luminances.push_back(luminance);
    }
    if (luminances.empty())
        return {};
    const double brightest = *std::max_element(luminances.begin(), luminances.end());
    if (brightest == 0.0)
        return {};
    double median = medianOf(luminances);
    if (median == 0.0) {
        std::erase(luminances, 0.0);
        median = medianOf(luminances);
    }
    FlipExposures exposures;
    exposures.startStops = std::log2(exposureTarget() / brightest);
    exposures.stopStops = std::log2(exposureTarget() / median);
    // The paper takes at least two exposures, but two equal ones are as good as one.
    exposures.count =
        exposures.stopStops > exposures.startStops
            ? std::max(2, static_cast<int>(std::ceil(exposures.stopStops - exposures.startStops)))
            : 1;
    return exposures;
}

ErrorMap flipLinear(const Image &reference, const Image &test, const FlipExposures &exposures,
                    double pixelsPerDegree) {
    assert(reference.width() == test.width() && reference.height() == test.height());
    assert(exposures.count >= 1);
    const FlipKernels kernels = makeFlipKernels(pixelsPerDegree);
    OpponentPlanes referencePlanes(reference.width(), reference.height());
    OpponentPlanes testPlanes(test.width(), test.height());

    ErrorMap largest{reference.width(), reference.height(),
                     std::vector<float>(reference.pixels().size(), 0.0f)};
    const double step =
        exposures.count > 1 ? (exposures.stopStops - exposures.startStops) / (exposures.count - 1) : 0.0;
    for (int i = 0; i < exposures.count; ++i) {
        const double scale = std::exp2(exposures.startStops + i * step);
        const auto toLinear = [scale](const glm::vec3 &c) {
            return glm::vec3(toneMapAces(c.x, scale), toneMapAces(c.y, scale), toneMapAces(c.z, scale));
        };
        referencePlanes.fill(reference, toLinear);
        testPlanes.fill(test, toLinear);
        const ErrorMap exposed = flipOfOpponents(referencePlanes, testPlanes, kernels);
        for (std::size_t pixel = 0; pixel < largest.errors.size(); ++pixel)
            largest.errors[pixel] = std::max(largest.errors[pixel], exposed.errors[pixel]);
    }
    for (std::size_t pixel = 0; pixel < largest.errors.size(); ++pixel)
        if (hasNan(reference.pixels()[pixel]) != hasNan(test.pixels()[pixel]))
            largest.errors[pixel] = 1.0f;
    return largest;
}

FlipSummary summarizeFlip(const ErrorMap &map, const Mask &mask) {
    assert(mask.empty() || mask.size() == map.errors.size());
    std::vector<float> errors;
    double sum = 0.0;
    for (std::size_t i = 0; i < map.errors.size(); ++i) {
        if (isCompared(mask, i)) {
            errors.push_back(map.errors[i]);
            sum += static_cast<double>(map.errors[i]);
        }
    }
    assert(!errors.empty());
    std::sort(errors.begin(), errors.end());

    FlipSummary summary;
    summary.mean = sum / static_cast<double>(errors.size());
    summary.max = static_cast<double>(errors.back());
    double runningSum = 0.0;
    for (const float error : errors) {
        runningSum += static_cast<double>(error);
        if (runningSum > 0.5 * sum) {
            summary.weightedMedian = static_cast<double>(error);
            break;
        }
    }
    return summary;
}

} // namespace hyalite::core
