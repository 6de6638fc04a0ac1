#include "tests/images/plain_comparison.h"

#include "tests/fixtures/test_extent.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyalite::core::testing {

namespace {

// Of all comparisons together, 2,000 at most, one in a hundred runs with other seeds would have a difference of more
// standard errors than this by chance (Šidák). Seeds are fixed, so a test that passes stays so until an image changes.
constexpr double maxStandardErrors = 4.6;

constexpr std::uint64_t plainSeed = 1;

std::vector<Estimate> plainEstimates(const TestScene &scene, const Comparison &comparison) {
    std::vector<Estimate> estimates;
    for (const Region &region : comparison.regions)
        estimates.push_back(estimatePlainly(scene, region.x0, region.x1, region.y0, region.y1,
                                            comparison.pathCount, plainSeed, comparison.search));
    return estimates;
}

void expectEqualMeans(const char *renderer, const Film &film, const TestScene &scene,
                      const Comparison &comparison, const std::vector<Estimate> &plain) {
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const Region &region = comparison.regions[i];
        const Estimate ours = meanOf(film, region);
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            const double expected = plain[i].mean[channel];
            const double error =
                std::sqrt(std::max(0.0, ours.variance[channel]) + std::max(0.0, plain[i].variance[channel]));
            const double difference = ours.mean[channel] - expected;
            SCOPED_TRACE(::testing::Message()
                         << renderer << ", channel " << channel << " of columns " << region.x0 << " to "
                         << region.x1 << ", rows " << region.y0 << " to " << region.y1 << ", seeds "
                         << scene.settings.seed << " and " << plainSeed << ": " << ours.mean[channel]
                         << " instead of " << expected << ", which differs by " << difference / expected
                         << " of it; standard error " << error / expected << " of it");
            EXPECT_LE(error, comparison.errorLimit * expected) << "too few samples to tell";
            EXPECT_LE(std::abs(difference), maxStandardErrors * error + comparison.allowance * expected);
        }
    }
}

} // namespace

Estimate meanOf(const Film &film, const Region &region) {
    Estimate estimate;
    const double pixelCount = static_cast<double>(region.x1 - region.x0) * (region.y1 - region.y0);
    for (int y = region.y0; y < region.y1; ++y) {
        for (int x = region.x0; x < region.x1; ++x) {
            const layout::FilmPixel &pixel = film.pixels[static_cast<std::size_t>(y * film.crop.width() + x)];
            const double count = pixel.sampleCount;
            const glm::dvec3 mean = sumOf(pixel) / count;
            estimate.mean += mean / pixelCount;
            estimate.variance += (glm::dvec3(pixel.sumOfSquares) / count - mean * mean) / (count - 1.0) /
                                 (pixelCount * pixelCount);
        }
    }
    return estimate;
}

void expectPlainRadiance(const char *renderer, const Film &film, const TestScene &scene,
                         const Comparison &comparison) {
    expectEqualMeans(renderer, film, scene, comparison, plainEstimates(scene, comparison));
}

void expectPlainRadiance(const TestScene &scene, const Comparison &comparison) {
    const std::vector<Estimate> plain = plainEstimates(scene, comparison);
    if (isTestingAll())
        expectEqualMeans("device", renderOnDevice(scene).film, scene, comparison, plain);
    expectEqualMeans("cpu", renderOnCpu(scene).film, scene, comparison, plain);
}

} // namespace hyalite::core::testing
