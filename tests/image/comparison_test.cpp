#include "host/image/comparison_json.h"

#include "host/image/ssim.h"
#include "tests/fixtures/synthetic_picture.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

TEST(Comparison, HoldsWhatTheMetricsSay) {
    const Image a = displayPicture(40, 30, 0);
    const Image b = displayPicture(40, 30, 2);
    const ImageComparison comparison = compareImages(a, b, Encoding::Display, 0.1);
    EXPECT_EQ(comparison.pixels.outlierCount, comparePixels(a, b, 0.1).outlierCount);
    EXPECT_EQ(comparison.ssim, meanSsim(a, b));
    EXPECT_EQ(comparison.flipMap.errors, flipDisplay(a, b).errors);
    EXPECT_FALSE(comparison.flipExposures.has_value());

    const Image c = linearPicture(40, 30, 0);
    const Image d = linearPicture(40, 30, 2);
    const ImageComparison linear = compareImages(c, d, Encoding::Linear);
    EXPECT_EQ(linear.flipMap.errors, flipLinear(c, d, flipExposures(c)).errors);
}

TEST(Comparison, IdenticalImagesHaveNoError) {
    const Image a = linearPicture(40, 30, 1);
    const ImageComparison comparison = compareImages(a, a, Encoding::Linear);
    EXPECT_TRUE(comparison.pixels.identical());
    EXPECT_EQ(comparison.flip.max, 0.0);
    EXPECT_EQ(comparison.flipMap.errors.size(), 1200u);
}

TEST(Comparison, WhatTheMaskLeavesOutHasNoEffectOnAnyMetric) {
    const Image a = displayPicture(40, 30, 0);
    Image b = a;
    b.at(30, 20).x += 0.25f; // compared
    Image c = b;
    Mask mask(40 * 30, 1);
    for (int y = 8; y < 14; ++y) {
        for (int x = 8; x < 20; ++x) {
            c.at(x, y) = glm::vec3(1.0f, 0.0f, 1.0f);
            mask[static_cast<std::size_t>(y * 40 + x)] = 0;
        }
    }
    const ImageComparison withoutPatch = compareImages(a, b, Encoding::Display, 0.0, mask);
    const ImageComparison withPatch = compareImages(a, c, Encoding::Display, 0.0, mask);
    EXPECT_EQ(withPatch.pixels.differingPixelCount, 1u);
    EXPECT_EQ(withPatch.pixels.meanSquaredError, withoutPatch.pixels.meanSquaredError);
    EXPECT_EQ(withPatch.ssim, withoutPatch.ssim);
    EXPECT_EQ(withPatch.flip.mean, withoutPatch.flip.mean);
    EXPECT_EQ(withPatch.flipMap.errors, withoutPatch.flipMap.errors);
    EXPECT_GT(withPatch.flip.mean, 0.0);
}

TEST(Comparison, JsonHasNullForWhatIsNotAvailable) {
    const Image a = linearPicture(8, 8, 0); // too small for SSIM
    const auto same =
        nlohmann::json::parse(comparisonToJson(compareImages(a, a, Encoding::Linear), a, a).dump());
    EXPECT_TRUE(same["identical"].get<bool>());
    EXPECT_TRUE(same["psnrDecibels"].is_null());
    EXPECT_TRUE(same["ssim"].is_null());
    EXPECT_FALSE(same.contains("worstPixel"));
    EXPECT_EQ(same["maxUlpDistance"], 0);
    EXPECT_EQ(same["flip"]["kind"], "HDR");

    Image b = a;
    b.at(3, 2).y += 1.0f;
    const auto other =
        nlohmann::json::parse(comparisonToJson(compareImages(a, b, Encoding::Display), a, b).dump());
    EXPECT_FALSE(other["identical"].get<bool>());
    EXPECT_EQ(other["worstPixel"]["x"], 3);
    EXPECT_EQ(other["worstPixel"]["y"], 2);
    EXPECT_EQ(other["flip"]["kind"], "LDR");
    EXPECT_FALSE(other.contains("maxUlpDistance"));
}

} // namespace
} // namespace hyalite::core
