#include "host/image/metrics.h"

#include "tests/fixtures/synthetic_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hyalite::core {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

TEST(Metrics, IdenticalImagesDifferInNothing) {
    const Image a = linearPicture(17, 9, 1);
    const PixelMetrics metrics = comparePixels(a, a);
    EXPECT_TRUE(metrics.identical());
    EXPECT_EQ(metrics.pixelCount, 153u);
    EXPECT_EQ(metrics.outlierCount, 0u);
    EXPECT_EQ(metrics.maxUlpDistance, 0u);
    EXPECT_EQ(metrics.maxAbsoluteDifference, 0.0);
    EXPECT_EQ(metrics.meanSquaredError, 0.0);
    EXPECT_EQ(metrics.psnrDecibels(), std::numeric_limits<double>::infinity());
}

TEST(Metrics, ClosedFormsOfAConstantDifference) {
    const Image a = constantPicture(4, 3, {0.5f, 0.5f, 0.5f});
    const Image b = constantPicture(4, 3, {0.5f, 0.25f, 0.75f});
    const PixelMetrics metrics = comparePixels(a, b);
    EXPECT_DOUBLE_EQ(metrics.meanSquaredError, 2.0 / 48.0);
    EXPECT_DOUBLE_EQ(metrics.psnrDecibels(), 10.0 * std::log10(24.0));
    EXPECT_DOUBLE_EQ(metrics.meanAbsoluteDifference, 0.5 / 3.0);
    EXPECT_DOUBLE_EQ(metrics.meanDifference, 0.0);
    EXPECT_EQ(metrics.maxAbsoluteDifference, 0.25);
    EXPECT_EQ(metrics.differingPixelCount, 12u);
}

TEST(Metrics, TheWorstPixelIsNamed) {
    const Image a = linearPicture(8, 8, 0);
    Image b = a;
    b.at(3, 5).y += 0.5f;
    b.at(6, 2).z -= 2.0f;
    const PixelMetrics metrics = comparePixels(a, b, 1.0);
    EXPECT_EQ(metrics.worstX, 6);
    EXPECT_EQ(metrics.worstY, 2);
    EXPECT_EQ(metrics.differingPixelCount, 2u);
    EXPECT_EQ(metrics.outlierCount, 1u);
    EXPECT_DOUBLE_EQ(metrics.outlierFraction(), 1.0 / 64.0);
}

TEST(Metrics, AnOutlierLiesAboveTheThresholdNotOnIt) {
    const Image a = constantPicture(1, 1, {0.0f, 0.0f, 0.0f});
    const Image b = constantPicture(1, 1, {0.25f, 0.0f, 0.0f});
    EXPECT_EQ(comparePixels(a, b, 0.25).outlierCount, 0u);
    EXPECT_EQ(comparePixels(a, b, 0.2499).outlierCount, 1u);
}

TEST(Metrics, UlpDistanceCountsFloatsAcrossZero) {
    const float smallest = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(ulpDistance(1.0f, std::nextafter(1.0f, 2.0f)), 1u);
    EXPECT_EQ(ulpDistance(1.0f, std::nextafter(1.0f, 0.0f)), 1u);
    EXPECT_EQ(ulpDistance(1.0f, 2.0f), 1u << 23);
    EXPECT_EQ(ulpDistance(-0.0f, 0.0f), 1u);
    EXPECT_EQ(ulpDistance(-smallest, smallest), 3u);
    EXPECT_EQ(ulpDistance(std::numeric_limits<float>::max(), infinity), 1u);
    EXPECT_EQ(ulpDistance(-1.0f, -1.0f), 0u);
    EXPECT_EQ(ulpDistance(3.0f, -2.0f), ulpDistance(-2.0f, 3.0f));
    EXPECT_EQ(ulpDistance(notANumber, notANumber), 0u);
    EXPECT_GT(ulpDistance(notANumber, infinity), 0u);
}

TEST(Metrics, ZerosOfBothSignsAreNotIdentical) {
    const PixelMetrics metrics =
        comparePixels(constantPicture(1, 1, glm::vec3(0.0f)), constantPicture(1, 1, glm::vec3(-0.0f)));
    EXPECT_FALSE(metrics.identical());
    EXPECT_EQ(metrics.maxUlpDistance, 1u);
    EXPECT_EQ(metrics.maxAbsoluteDifference, 0.0);
}

TEST(Metrics, EqualNansAreEqualAndAnyOtherIsInfinitelyFar) {
    Image a = constantPicture(2, 1, glm::vec3(1.0f));
    a.at(0, 0).x = notANumber;
    a.at(1, 0).y = infinity;
    EXPECT_TRUE(comparePixels(a, a).identical());
    EXPECT_EQ(comparePixels(a, a).nonFiniteCount, 2u);

    Image b = a;
    b.at(0, 0).x = 1.0f;
    const PixelMetrics metrics = comparePixels(a, b, 1e30);
    EXPECT_EQ(metrics.differingPixelCount, 1u);
    EXPECT_EQ(metrics.outlierCount, 1u);
    EXPECT_EQ(metrics.maxAbsoluteDifference, std::numeric_limits<double>::infinity());
    EXPECT_EQ(metrics.psnrDecibels(), -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(metrics.meanDifference));
}

TEST(Metrics, PixelsOutsideTheMaskDoNotCount) {
    const Image a = linearPicture(8, 4, 0);
    Image b = a;
    b.at(2, 1).x += 1.0f;
    Image maskImage = constantPicture(8, 4, glm::vec3(1.0f));
    EXPECT_FALSE(comparePixels(a, b, 0.0, maskFromImage(maskImage)).identical());
    maskImage.at(2, 1) = {0.49f, 0.0f, 0.0f};
    const PixelMetrics metrics = comparePixels(a, b, 0.0, maskFromImage(maskImage));
    EXPECT_TRUE(metrics.identical());
    EXPECT_EQ(metrics.pixelCount, 31u);
}

TEST(Metrics, AgreeWithScikitImage) {
    // skimage.metrics.peak_signal_noise_ratio(a, b, data_range=1) of the same pictures in double.
    const PixelMetrics metrics = comparePixels(displayPicture(64, 48, 0), displayPicture(64, 48, 2));
    EXPECT_NEAR(metrics.psnrDecibels(), 22.772865746812588, 1e-6);
    EXPECT_NEAR(metrics.meanSquaredError, 0.00528096665545303, 1e-9);
}

} // namespace
} // namespace hyalite::core
