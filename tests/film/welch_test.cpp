#include "host/film/welch_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>

namespace hyalite::core {
namespace {

using Draw = std::function<float(std::mt19937 &)>;

/// A film whose samples are all drawn alike, times `scale`.
Film filmOf(int side, std::uint32_t sampleCount, std::uint32_t seed, const Draw &draw, float scale = 1.0f) {
    std::mt19937 random(seed);
    Film film({0, side, 0, side});
    for (layout::FilmPixel &pixel : film.pixels) {
        pixel.sampleCount = sampleCount;
        for (std::uint32_t i = 0; i < sampleCount; ++i) {
            const glm::vec3 radiance = scale * glm::vec3(draw(random), draw(random), draw(random));
            pixel.sum += radiance;
            pixel.sumOfSquares += radiance * radiance;
        }
    }
    return film;
}

WelchResult test(const Film &a, const Film &b) { return welchTest(estimateOf(a), estimateOf(b)); }

float uniform(std::mt19937 &random) { return std::uniform_real_distribution<float>(0.5f, 1.5f)(random); }
float normal(std::mt19937 &random) { return std::normal_distribution<float>(1.0f, 0.1f)(random); }
/// A light that is found by one sample in ten.
float rare(std::mt19937 &random) { return random() % 10 == 0 ? 10.0f : 0.0f; }
float exponential(std::mt19937 &random) { return std::exponential_distribution<float>(1.0f)(random); }

TEST(ZTest, StudentsQuantilesBecomeNormalOnes) {
    // Two-sided probabilities 0.05, 0.001 and 1e-6, from tables.
    EXPECT_NEAR(normalDeviateOfStudent(2.1314, 15.0), 1.9600, 0.005);
    EXPECT_NEAR(normalDeviateOfStudent(4.0728, 15.0), 3.2905, 0.01);
    EXPECT_NEAR(normalDeviateOfStudent(3.6460, 30.0), 3.2905, 0.01);
    EXPECT_NEAR(normalDeviateOfStudent(-4.0728, 15.0), -3.2905, 0.01);
    EXPECT_EQ(normalDeviateOfStudent(3.0, std::numeric_limits<double>::infinity()), 3.0);
    EXPECT_EQ(normalDeviateOfStudent(0.0, 15.0), 0.0);
}

TEST(ZTest, TheThresholdIsSidaks) {
    EXPECT_NEAR(sidakThreshold(0.05, 1), 1.959964, 1e-6);
    EXPECT_NEAR(sidakThreshold(0.01, 1), 2.575829, 1e-6);
    // 1 - 0.99^(1/1000) = 1.00503e-5 on both sides.
    EXPECT_NEAR(std::erfc(sidakThreshold(0.01, 1000) / std::sqrt(2.0)), 1.00503e-5, 1e-9);
    EXPECT_GT(sidakThreshold(0.01, 1000000), sidakThreshold(0.01, 1000));
    EXPECT_LT(sidakThreshold(1e-12, std::uint64_t{1} << 40), 38.0);
}

TEST(ZTest, EqualDistributionsPass) {
    for (const Draw &draw : {Draw(uniform), Draw(normal), Draw(rare), Draw(exponential)})
        for (const std::uint32_t count : {16u, 64u}) {
            const WelchResult result = test(filmOf(48, count, 1, draw), filmOf(48, count, 2, draw));
            EXPECT_TRUE(result.isPassed()) << count << ": " << result.largest;
            EXPECT_EQ(result.testCount, 48u * 48u * 3u + 3u);
            EXPECT_EQ(result.untestedCount, 0u);
            EXPECT_GT(result.largest, 2.5); // of 6,912
        }
}

TEST(ZTest, SampleCountsMayDiffer) {
    EXPECT_TRUE(test(filmOf(32, 16, 1, uniform), filmOf(32, 256, 2, uniform)).isPassed());
}

TEST(ZTest, DeviatesAreNormal) {
    // About 5 % exceed 1.96: half a standard deviation of the share is 0.2 %.
    const Film a = filmOf(40, 64, 3, normal);
    const Film b = filmOf(40, 64, 4, normal);
    int exceeding = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        Film oneA({0, 1, 0, 1});
        Film oneB({0, 1, 0, 1});
        oneA.pixels.front() = a.pixels[i];
        oneB.pixels.front() = b.pixels[i];
        exceeding += test(oneA, oneB).largest > 1.96;
    }
    // The largest of three: 1 - 0.95^3.
    EXPECT_NEAR(exceeding / 1600.0, 0.142625, 0.03);
}

TEST(ZTest, ABiasOfOnePercentIsCaught) {
    // Noise of 10 %: of the mean of 64 samples 1.25 %, over 1,024 pixels 0.04 %. No pixel shows it, the image does.
    const Film a = filmOf(32, 64, 1, normal);
    const WelchResult result = test(a, filmOf(32, 64, 2, normal, 1.01f));
    EXPECT_FALSE(result.isPassed());
    for (const double z : result.ofImage)
        EXPECT_LT(z, -10.0);
    EXPECT_TRUE(test(a, filmOf(32, 64, 2, normal)).isPassed());
}

TEST(ZTest, ABiasOfOnePercentInOnePixelIsCaught) {
    // 16,384 samples: a noise of 0.08 %.
    const Film a = filmOf(4, 16384, 1, normal);
    Film b = filmOf(4, 16384, 2, normal);
    EXPECT_TRUE(test(a, b).isPassed());
    b.pixels[6].sum.y *= 1.01f;
    b.pixels[6].sumOfSquares.y *= 1.01f * 1.01f;
    const WelchResult result = test(a, b);
    EXPECT_FALSE(result.isPassed());
    EXPECT_EQ(result.x, 2);
    EXPECT_EQ(result.y, 1);
    EXPECT_EQ(result.channel, 1);
}

TEST(ZTest, DeterministicPixelsDifferByMoreThanTheFilmResolves) {
    const auto constant = [](std::mt19937 &) { return 0.3f; };
    const Film a = filmOf(3, 64, 1, constant);
    EXPECT_TRUE(test(a, a).isPassed());
    EXPECT_TRUE(test(a, filmOf(3, 64, 1, constant, 1.0001f)).isPassed());
    EXPECT_FALSE(test(a, filmOf(3, 64, 1, constant, 1.01f)).isPassed());
}

TEST(ZTest, PixelsWithoutVarianceOrOfFewSamplesAreLeftOut) {
    Film a = filmOf(4, 16, 1, uniform);
    Film b = filmOf(4, 16, 2, uniform);
    a.pixels[0] = {};
    a.pixels[1].sampleCount = 1;
    b.pixels[2].sampleCount = 15;
    b.pixels[2].sum *= 100.0f;
    const WelchResult result = test(a, b);
    EXPECT_EQ(result.untestedCount, 9u);
    EXPECT_EQ(result.testCount, 13u * 3u + 3u);
    EXPECT_TRUE(result.isPassed());
    EXPECT_EQ(test(filmOf(2, 4, 1, uniform), filmOf(2, 4, 2, uniform)).testCount, 0u);
}

TEST(ZTest, WithoutCountsVariancesAreExact) {
    Estimate a = estimateOf(filmOf(16, 4, 1, normal));
    Estimate b = estimateOf(filmOf(16, 4, 2, normal));
    a.counts.reset();
    b.counts.reset();
    for (Estimate *estimate : {&a, &b})
        for (glm::vec3 &variance : estimate->variance.pixels())
            variance = glm::vec3(0.01f / 4.0f);
    EXPECT_TRUE(welchTest(a, b).isPassed());
    EXPECT_EQ(welchTest(a, b).untestedCount, 0u);
}

TEST(ZTest, NotANumberOnOneSideFails) {
    const Estimate a = estimateOf(filmOf(4, 16, 1, uniform));
    Estimate b = estimateOf(filmOf(4, 16, 2, uniform));
    b.mean.at(1, 2).z = std::numeric_limits<float>::quiet_NaN();
    const WelchResult result = welchTest(a, b);
    EXPECT_EQ(result.failureCount, 1u);
    EXPECT_EQ(result.x, 1);
    EXPECT_EQ(result.y, 2);
    EXPECT_EQ(result.channel, 2);
    EXPECT_TRUE(welchTest(b, b).isPassed());
}

} // namespace
} // namespace hyalite::core
