#include "host/film/welch_test.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace hyalite::core {

namespace {

/// One side of a test.
struct Sample {
    double mean = 0.0;
    double variance = 0.0;         ///< of the mean
    double degreesOfFreedom = 0.0; ///< infinite where the variance is exact
};

std::optional<Sample> sampleAt(const Estimate &estimate, std::size_t pixel, int channel, int minSampleCount) {
    Sample sample;
    sample.mean = static_cast<double>(estimate.mean.pixels()[pixel][channel]);
    sample.variance = static_cast<double>(estimate.variance.pixels()[pixel][channel]);
    sample.degreesOfFreedom = std::numeric_limits<double>::infinity();
    if (estimate.counts) {
        const double count = static_cast<double>(estimate.counts->pixels()[pixel].x);
        if (!(count >= minSampleCount))
            return std::nullopt;
        sample.degreesOfFreedom = count - 1.0;
    }
    return sample;
}

double varianceOfDifference(const Sample &a, const Sample &b) {
    constexpr double resolution = 0x1p-24;
    return a.variance + b.variance + resolution * (a.mean * a.mean + b.mean * b.mean);
}

/// The normal deviate of the difference, or nothing where it cannot be tested.
std::optional<double> deviate(const Sample &a, const Sample &b) {
    if (std::isfinite(a.mean) != std::isfinite(b.mean))
        return std::numeric_limits<double>::infinity();
    const auto isUsable = [](const Sample &s) {
        return std::isfinite(s.mean) && std::isfinite(s.variance) && s.variance >= 0.0;
    };
    if (!isUsable(a) || !isUsable(b))
        return std::nullopt;
    const double difference = a.mean - b.mean;
    if (difference == 0.0)
        return 0.0;
    const double variance = varianceOfDifference(a, b);
    const double uncertainty =
        a.variance * a.variance / a.degreesOfFreedom + b.variance * b.variance / b.degreesOfFreedom;
    return normalDeviateOfStudent(difference / std::sqrt(variance),
                                  uncertainty > 0.0 ? variance * variance / uncertainty
                                                    : std::numeric_limits<double>::infinity());
}

} // namespace

Estimate estimateOf(const Film &film) {
    Estimate estimate{film.toImage(), Image(film.crop.width(), film.crop.height()),
                      Image(film.crop.width(), film.crop.height())};
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        estimate.variance.pixels()[i] = glm::vec3(varianceOfMean(film.pixels[i]));
        estimate.counts->pixels()[i] = glm::vec3(static_cast<float>(film.pixels[i].sampleCount));
    }
    return estimate;
}

double normalDeviateOfStudent(double t, double degreesOfFreedom) {
    const double n = degreesOfFreedom;
    if (n > 1e12)
        return t;
    return std::copysign((8.0 * n + 1.0) / (8.0 * n + 3.0) * std::sqrt(n * std::log1p(t * t / n)), t);
}

double sidakThreshold(double significance, std::uint64_t testCount) {
    assert(significance > 0.0 && significance < 1.0 && testCount > 0);
    const double each = -std::expm1(std::log1p(-significance) / static_cast<double>(testCount));
    double low = 0.0; // where P(|z| > low) = erfc(low / sqrt 2) >= each > P(|z| > high)
    double high = 38.0;
    for (int step = 0; step < 100; ++step) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) >= each ? low : high) = middle;
    }
    return high;
}

WelchResult welchTest(const Estimate &a, const Estimate &b, const WelchOptions &options) {
    const std::size_t pixelCount = a.mean.pixels().size();
    assert(a.variance.pixels().size() == pixelCount && b.mean.pixels().size() == pixelCount &&
           b.variance.pixels().size() == pixelCount);
    WelchResult result;
    std::vector<double> deviates(3 * pixelCount, std::numeric_limits<double>::quiet_NaN());
    for (int channel = 0; channel < 3; ++channel) {
        double difference = 0.0; // of the whole image
        double variance = 0.0;
        bool isTested = false;
        for (std::size_t i = 0; i < pixelCount; ++i) {
            const std::optional<Sample> sampleA = sampleAt(a, i, channel, options.minSampleCount);
            const std::optional<Sample> sampleB = sampleAt(b, i, channel, options.minSampleCount);
            const std::optional<double> z = sampleA && sampleB ? deviate(*sampleA, *sampleB) : std::nullopt;
            if (!z) {
                ++result.untestedCount;
                continue;
            }
            deviates[3 * i + static_cast<std::size_t>(channel)] = *z;
            ++result.testCount;
            if (std::abs(*z) > result.largest) {
                result.largest = std::abs(*z);
                result.x = static_cast<int>(i) % a.mean.width();
                result.y = static_cast<int>(i) / a.mean.width();
                result.channel = channel;
            }
            if (!std::isfinite(*z))
                continue;
            isTested = true;
            difference += sampleA->mean - sampleB->mean;
            variance += varianceOfDifference(*sampleA, *sampleB);
        }
        if (isTested) {
            ++result.testCount;
            result.ofImage[static_cast<std::size_t>(channel)] =
                variance > 0.0 ? difference / std::sqrt(variance) : 0.0;
        }
    }
    if (result.testCount == 0)
        return result;
    result.threshold = sidakThreshold(options.significance, result.testCount);
    const auto isFailure = [&](double z) { return std::abs(z) > result.threshold; };
    result.failureCount =
        static_cast<std::uint64_t>(std::count_if(deviates.begin(), deviates.end(), isFailure) +
                                   std::count_if(result.ofImage.begin(), result.ofImage.end(), isFailure));
    return result;
}

} // namespace hyalite::core
