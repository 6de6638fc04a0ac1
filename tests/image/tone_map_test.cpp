#include "host/image/tone_map.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace hyalite::core {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

/// The definition, in double.
int levelByPow(double linear) {
    return static_cast<int>(
        std::floor(255.0 * std::pow(std::fmin(std::fmax(linear, 0.0), 1.0), 1.0 / 2.2) + 0.5));
}

Image imageOf(float value) {
    Image image(1, 1);
    image.at(0, 0) = glm::vec3(value);
    return image;
}

TEST(ToneMap, ThresholdsAreTheSmallestFloatsOfTheirLevels) {
    const auto &thresholds = toneMapThresholds();
    for (int level = 1; level <= 255; ++level) {
        const float threshold = thresholds[static_cast<std::size_t>(level) - 1];
        const float below = std::nextafter(threshold, 0.0f);
        EXPECT_EQ(levelByPow(static_cast<double>(threshold)), level);
        EXPECT_EQ(levelByPow(static_cast<double>(below)), level - 1);
        EXPECT_EQ(encodeLevel(threshold), level);
        EXPECT_EQ(encodeLevel(below), level - 1);
    }
}

TEST(ToneMap, ThresholdsDoNotDependOnTheLibrarysPow) {
    // The exact threshold lies at least 1e-11 from the floats on both sides, relatively; pow() errs by 1e-15.
    for (int level = 1; level <= 255; ++level) {
        const long double exact = std::pow((static_cast<long double>(level) - 0.5L) / 255.0L, 2.2L);
        const float threshold = toneMapThresholds()[static_cast<std::size_t>(level) - 1];
        const float below = std::nextafter(threshold, 0.0f);
        EXPECT_GT(static_cast<long double>(threshold) / exact - 1.0L, 1e-11L) << level;
        EXPECT_GT(1.0L - static_cast<long double>(below) / exact, 1e-11L) << level;
    }
}

TEST(ToneMap, EveryLevelComesBackFromItsCentre) {
    for (int level = 0; level <= 255; ++level)
        EXPECT_EQ(encodeLevel(static_cast<float>(std::pow(level / 255.0, 2.2))), level);
}

TEST(ToneMap, AgreesWithPowOnRandomFloats) {
    constexpr std::uint32_t seed = 20240601;
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::uint32_t> bits(0, std::bit_cast<std::uint32_t>(4.0f));
    std::uniform_real_distribution<float> uniform(0.0f, 1.1f);
    for (int i = 0; i < 1'000'000; ++i) {
        const float c = i % 2 == 0 ? std::bit_cast<float>(bits(random)) : uniform(random);
        ASSERT_EQ(encodeLevel(c), levelByPow(static_cast<double>(c))) << c;
    }
}

TEST(ToneMap, KnownLevels) {
    EXPECT_EQ(encodeLevel(0.0f), 0);
    EXPECT_EQ(encodeLevel(0.18f), 117);
    EXPECT_EQ(encodeLevel(0.5f), 186);
    EXPECT_EQ(encodeLevel(1.0f), 255);
}

TEST(ToneMap, ClampsWhatIsNoColour) {
    for (const double exposure : {-2.0, 0.0, 3.5}) {
        EXPECT_EQ(toneMap(imageOf(notANumber), exposure)[0], 0);
        EXPECT_EQ(toneMap(imageOf(-notANumber), exposure)[0], 0);
        EXPECT_EQ(toneMap(imageOf(-1.0f), exposure)[0], 0);
        EXPECT_EQ(toneMap(imageOf(-0.0f), exposure)[0], 0);
        EXPECT_EQ(toneMap(imageOf(-infinity), exposure)[0], 0);
        EXPECT_EQ(toneMap(imageOf(infinity), exposure)[0], 255);
        EXPECT_EQ(toneMap(imageOf(std::numeric_limits<float>::max()), exposure)[0], 255);
        EXPECT_EQ(toneMap(imageOf(std::numeric_limits<float>::denorm_min()), exposure)[0], 0);
    }
}

TEST(ToneMap, AStopDoublesTheLight) {
    for (float c = 0.001f; c < 1.0f; c *= 1.07f) {
        EXPECT_EQ(toneMap(imageOf(c), 1.0)[0], encodeLevel(2.0f * c));
        EXPECT_EQ(toneMap(imageOf(c), -3.0)[0], encodeLevel(c / 8.0f));
        const auto exposed = static_cast<float>(static_cast<double>(c) * std::exp2(0.7));
        EXPECT_EQ(toneMap(imageOf(c), 0.7)[0], encodeLevel(exposed));
    }
}

TEST(ToneMap, ExtremeExposuresSaturate) {
    EXPECT_EQ(toneMap(imageOf(std::numeric_limits<float>::denorm_min()), 1e6)[0], 255);
    EXPECT_EQ(toneMap(imageOf(std::numeric_limits<float>::max()), -1e6)[0], 0);
    EXPECT_EQ(toneMap(imageOf(0.0f), 1e6)[0], 0);
    EXPECT_EQ(toneMap(imageOf(infinity), -1e6)[0], 255);
}

TEST(ToneMap, RowsAreInOrderFromTheTopLeft) {
    Image image(2, 2);
    image.at(0, 0) = {1.0f, 0.0f, 0.0f};
    image.at(1, 0) = {0.0f, 1.0f, 0.0f};
    image.at(0, 1) = {0.0f, 0.0f, 1.0f};
    EXPECT_EQ(toneMap(image, 0.0), (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}));
}

} // namespace
} // namespace hyalite::core
