#include "host/image/flip.h"

#include "host/image/flip_colour.h"
#include "host/image/flip_kernels.h"
#include "tests/fixtures/synthetic_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hyalite::core {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

double meanFlip(const glm::vec3 &reference, const glm::vec3 &test) {
    return summarizeFlip(flipDisplay(constantPicture(32, 32, reference), constantPicture(32, 32, test))).mean;
}

float errorAt(const ErrorMap &map, int x, int y) {
    return map.errors[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                      static_cast<std::size_t>(x)];
}

double sumOf(const Kernel &kernel, float sign) {
    double sum = 0.0;
    for (const float weight : kernel)
        sum += weight * sign > 0.0f ? static_cast<double>(weight) : 0.0;
    return sum;
}

TEST(Flip, KernelsHaveThePublishedSizesAndSums) {
    EXPECT_NEAR(flipPixelsPerDegree, 0.7 * 3840.0 / 0.7 * std::numbers::pi / 180.0, 1e-12);
    const FlipKernels kernels = makeFlipKernels(flipPixelsPerDegree);
    EXPECT_EQ(kernels.achromatic.size(), 21u); // radius 10
    EXPECT_EQ(kernels.redGreen.size(), 21u);
    EXPECT_EQ(kernels.blueYellow1.size(), 21u);
    EXPECT_EQ(kernels.blueYellow2.size(), 21u);
    EXPECT_EQ(kernels.edge.size(), 19u); // radius 9
    EXPECT_NEAR(sumOf(kernels.achromatic, 1.0f), 1.0, 1e-6);
    EXPECT_NEAR(sumOf(kernels.redGreen, 1.0f), 1.0, 1e-6);
    const double sum1 = sumOf(kernels.blueYellow1, 1.0f);
    const double sum2 = sumOf(kernels.blueYellow2, 1.0f);
    EXPECT_NEAR(sum1 * sum1 + sum2 * sum2, 1.0, 1e-6);
    EXPECT_NEAR(sumOf(kernels.gaussian, 1.0f), 1.0, 1e-6);
    for (const Kernel &kernel : {kernels.edge, kernels.point}) {
        EXPECT_NEAR(sumOf(kernel, 1.0f), 1.0, 1e-6);
        EXPECT_NEAR(sumOf(kernel, -1.0f), -1.0, 1e-6);
    }
}

TEST(Flip, ColourSpacesHaveKnownValues) {
    const glm::vec3 white = huntLabFromLinear(glm::vec3(1.0f));
    EXPECT_NEAR(white.x, 100.0f, 1e-3f);
    EXPECT_NEAR(white.y, 0.0f, 1e-2f);
    EXPECT_NEAR(white.z, 0.0f, 1e-2f);
    const glm::vec3 green = huntLabFromLinear({0.0f, 1.0f, 0.0f}); // CIELab (87.7, -86.2, 83.2)
    EXPECT_NEAR(green.x, 87.7f, 0.1f);
    EXPECT_NEAR(green.y, -86.2f * 0.877f, 0.2f);
    EXPECT_NEAR(green.z, 83.2f * 0.877f, 0.2f);
    const glm::vec3 colour = {0.2f, 0.7f, 0.4f};
    const glm::vec3 back = linearFromOpponent(opponentFromLinear(colour));
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(back[channel], colour[channel], 1e-5f);
    EXPECT_NEAR(linearFromSrgb(0.5f), 0.21404114f, 1e-6f);
    EXPECT_EQ(linearFromSrgb(1.0f), 1.0f);
}

TEST(Flip, IdenticalPicturesHaveNoError) {
    const Image display = displayPicture(40, 30, 1);
    EXPECT_EQ(summarizeFlip(flipDisplay(display, display)).max, 0.0);
    const Image linear = linearPicture(40, 30, 1);
    EXPECT_EQ(summarizeFlip(flipLinear(linear, linear, flipExposures(linear))).max, 0.0);
}

TEST(Flip, ConstantPicturesHaveTheValuesOfThePublishedFormulas) {
    // From the formulas of the publication in double, with two-dimensional filters, computed apart from this program.
    EXPECT_NEAR(meanFlip(glm::vec3(0.0f), glm::vec3(1.0f)), 0.9673797634, 1e-4);
    EXPECT_NEAR(meanFlip({0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}), 1.0, 1e-4);
    EXPECT_NEAR(meanFlip({1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}), 0.9866622751, 1e-4);
    EXPECT_NEAR(meanFlip({0.5f, 0.5f, 0.5f}, {0.51f, 0.5f, 0.5f}), 0.0474358392, 1e-4);
    EXPECT_NEAR(meanFlip({0.2f, 0.4f, 0.6f}, {0.6f, 0.4f, 0.2f}), 0.7299005025, 1e-4);
}

TEST(Flip, PicturesHaveTheValuesOfThePublishedFormulas) {
    const ErrorMap map = flipDisplay(displayPicture(64, 48, 0), displayPicture(64, 48, 2));
    const FlipSummary summary = summarizeFlip(map);
    EXPECT_NEAR(summary.mean, 0.0844700107, 1e-4);
    EXPECT_NEAR(summary.max, 0.9202603774, 1e-3);
    EXPECT_NEAR(errorAt(map, 0, 0), 0.0742808249f, 1e-3f);
    EXPECT_NEAR(errorAt(map, 15, 12), 0.7732084835f, 1e-3f);
    EXPECT_NEAR(errorAt(map, 32, 24), 0.1291529594f, 1e-3f);
    EXPECT_NEAR(errorAt(map, 63, 47), 0.0f, 1e-3f);
}

TEST(Flip, LinearPicturesHaveTheValuesOfThePublishedFormulas) {
    const Image reference = linearPicture(64, 48, 0);
    const FlipExposures exposures = flipExposures(reference);
    EXPECT_NEAR(exposures.startStops, -3.6500236178, 1e-5);
    EXPECT_NEAR(exposures.stopStops, -0.5662707708, 1e-5);
    EXPECT_EQ(exposures.count, 4);
    const ErrorMap map = flipLinear(reference, linearPicture(64, 48, 2), exposures);
    const FlipSummary summary = summarizeFlip(map);
    EXPECT_NEAR(summary.mean, 0.1304789955, 1e-4);
    EXPECT_NEAR(summary.max, 0.9788247717, 1e-3);
    EXPECT_NEAR(errorAt(map, 15, 12), 0.9769444486f, 1e-3f);
    EXPECT_NEAR(errorAt(map, 32, 24), 0.2984006042f, 1e-3f);
}

TEST(Flip, IsSymmetric) {
    const Image a = displayPicture(40, 30, 0);
    const Image b = displayPicture(40, 30, 2);
    EXPECT_EQ(flipDisplay(a, b).errors, flipDisplay(b, a).errors);
}

TEST(Flip, GrowsWithTheDifferenceAndStaysInRange) {
    double last = 0.0;
    for (int step = 1; step <= 10; ++step) {
        const double mean = meanFlip(glm::vec3(0.2f), glm::vec3(0.2f + 0.08f * static_cast<float>(step)));
        EXPECT_GT(mean, last);
        EXPECT_LE(mean, 1.0);
        last = mean;
    }
}

TEST(Flip, AFarPixelDoesNotChangeAnError) {
    const Image a = displayPicture(64, 40, 0);
    Image b = a;
    b.at(5, 5) = glm::vec3(1.0f, 0.0f, 1.0f);
    const ErrorMap map = flipDisplay(a, b);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 64; ++x)
            if (std::abs(x - 5) > 10 || std::abs(y - 5) > 10) {
                ASSERT_EQ(errorAt(map, x, y), 0.0f) << x << ' ' << y;
            }
    }
    EXPECT_GT(errorAt(map, 5, 5), 0.1f);
}

TEST(Flip, AnySizeWorks) {
    for (const int width : {1, 2, 15, 16, 17, 33}) {
        for (const int height : {1, 3}) {
            const Image a = constantPicture(width, height, glm::vec3(0.0f));
            const Image b = constantPicture(width, height, glm::vec3(1.0f));
            const ErrorMap map = flipDisplay(a, b);
            ASSERT_EQ(map.errors.size(), static_cast<std::size_t>(width * height));
            for (const float error : map.errors)
                EXPECT_NEAR(error, 0.9673797634f, 1e-4f) << width << " x " << height;
        }
    }
}

TEST(Flip, ExposuresFollowTheLuminancesOfTheReference) {
    const FlipExposures black = flipExposures(constantPicture(4, 4, glm::vec3(0.0f)));
    EXPECT_EQ(black.count, 1);
    EXPECT_EQ(black.startStops, 0.0);

    const FlipExposures grey = flipExposures(constantPicture(4, 4, glm::vec3(1.0f)));
    EXPECT_EQ(grey.count, 1);
    // The ACES curve gives 0.85 there.
    const double x = std::exp2(grey.startStops) * 0.6;
    EXPECT_NEAR((2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14), 0.85, 1e-6);

    Image contrast = constantPicture(4, 4, glm::vec3(1.0f));
    contrast.at(0, 0) = glm::vec3(1000.0f);
    const FlipExposures wide = flipExposures(contrast);
    EXPECT_NEAR(wide.stopStops - wide.startStops, std::log2(1000.0), 1e-6);
    EXPECT_EQ(wide.count, 10);

    // Mostly black: the median is 0, and that of the rest is taken.
    Image dark = constantPicture(4, 4, glm::vec3(0.0f));
    dark.at(0, 0) = glm::vec3(8.0f);
    dark.at(1, 0) = glm::vec3(2.0f);
    dark.at(2, 0) = glm::vec3(2.0f);
    const FlipExposures sparse = flipExposures(dark);
    EXPECT_EQ(sparse.count, 2);
    EXPECT_NEAR(sparse.stopStops - sparse.startStops, 2.0, 1e-6);

    contrast.at(1, 1) = glm::vec3(infinity);
    contrast.at(2, 2) = glm::vec3(notANumber);
    EXPECT_NEAR(flipExposures(contrast).startStops, wide.startStops, 1e-9);
}

TEST(Flip, ValuesThatAreNoColoursDoNotSpread) {
    const Image a = linearPicture(48, 48, 0);
    Image b = a;
    b.at(20, 20).x = notANumber;
    const ErrorMap map = flipLinear(a, b, flipExposures(a));
    for (const float error : map.errors)
        ASSERT_TRUE(error >= 0.0f && error <= 1.0f);
    EXPECT_EQ(errorAt(map, 20, 20), 1.0f);
    EXPECT_EQ(errorAt(map, 40, 40), 0.0f);

    Image bright = a;
    bright.at(20, 20) = glm::vec3(infinity);
    Image bad = a;
    bad.at(20, 20) = glm::vec3(-infinity, std::numeric_limits<float>::max(), -1.0f);
    for (const float error : flipLinear(bright, bad, flipExposures(bright)).errors)
        ASSERT_TRUE(error >= 0.0f && error <= 1.0f);
    for (const float error : flipDisplay(bright, bad).errors)
        ASSERT_TRUE(error >= 0.0f && error <= 1.0f);
}

TEST(Flip, TheSummaryPoolsTheComparedPixels) {
    const ErrorMap map{4, 1, {0.1f, 0.2f, 0.3f, 1.0f}};
    const FlipSummary all = summarizeFlip(map);
    EXPECT_NEAR(all.mean, 0.4, 1e-7);
    EXPECT_NEAR(all.weightedMedian, 1.0, 1e-7); // the last pixel has more than half of all error
    EXPECT_NEAR(all.max, 1.0, 1e-7);
    const FlipSummary some = summarizeFlip(map, {1, 1, 1, 0});
    EXPECT_NEAR(some.mean, 0.2, 1e-7);
    EXPECT_NEAR(some.weightedMedian, 0.3f, 1e-7); // 0.1 + 0.2 is half, not more
    EXPECT_NEAR(some.max, 0.3f, 1e-7);
}

} // namespace
} // namespace hyalite::core
