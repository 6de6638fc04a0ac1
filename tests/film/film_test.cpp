#include "host/film/film.h"
#include "host/image/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <random>
#include <vector>

namespace hyalite::core {
namespace {

layout::FilmPixel pixelOf(std::initializer_list<float> samples) {
    layout::FilmPixel pixel{};
    for (const float sample : samples) {
        const glm::vec3 radiance(sample, 2.0f * sample, 1.0f);
        pixel.sum += radiance;
        pixel.sumOfSquares += radiance * radiance;
        ++pixel.sampleCount;
    }
    return pixel;
}

TEST(Film, VarianceIsThatOfTheMean) {
    // Mean 3, squared deviations 4 + 1 + 0 + 9 = 14: a variance of 14/3, and a quarter of it of the mean.
    const glm::dvec3 variance = varianceOfMean(pixelOf({1.0f, 2.0f, 3.0f, 6.0f}));
    EXPECT_DOUBLE_EQ(variance.x, 14.0 / 3.0 / 4.0);
    EXPECT_DOUBLE_EQ(variance.y, 4.0 * 14.0 / 3.0 / 4.0);
    EXPECT_EQ(variance.z, 0.0);
}

TEST(Film, VarianceIsUndefinedBelowTwoSamples) {
    EXPECT_TRUE(std::isnan(varianceOfMean(pixelOf({})).x));
    EXPECT_TRUE(std::isnan(varianceOfMean(pixelOf({1.0f})).x));
    EXPECT_EQ(varianceOfMean(pixelOf({1.0f, 1.0f})).x, 0.0);
}

TEST(Film, RoundingMakesNoNegativeVariance) {
    layout::FilmPixel pixel{};
    for (int i = 0; i < 1000; ++i) {
        pixel.sum += glm::vec3(0.1f);
        pixel.sumOfSquares += glm::vec3(0.1f * 0.1f);
        ++pixel.sampleCount;
    }
    EXPECT_GE(varianceOfMean(pixel).x, 0.0);
    EXPECT_LT(varianceOfMean(pixel).x, 1e-7);
}

TEST(Film, VarianceIsUnbiased) {
    // Of uniform numbers 1/12; without Bessel's correction it would be 20 % less for five samples.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    constexpr int pixelCount = 20000;
    double sum = 0.0;
    for (int i = 0; i < pixelCount; ++i)
        sum += varianceOfMean(pixelOf({uniform(random), uniform(random), uniform(random), uniform(random),
                                       uniform(random)}))
                   .x;
    EXPECT_NEAR(sum / pixelCount, 1.0 / 12.0 / 5.0, 0.01 / 12.0 / 5.0);
}

TEST(Film, LayersAreVarianceAndSamples) {
    Film film({2, 4, 1, 3});
    film.pixels = {pixelOf({1.0f, 2.0f}), pixelOf({1.0f}), pixelOf({}), pixelOf({3.0f, 3.0f, 6.0f})};
    const std::vector<Layer> layers = filmLayers(film);
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].name, "variance");
    EXPECT_EQ(layers[0].channels, "RGB");
    EXPECT_EQ(layers[1].name, "samples");
    EXPECT_EQ(layers[1].channels, "Y");
    std::vector<float> row(6);
    layers[0].fillRow(0, row);
    EXPECT_EQ(row[0], 0.25f);
    EXPECT_EQ(row[1], 1.0f);
    EXPECT_EQ(row[2], 0.0f);
    EXPECT_TRUE(std::isnan(row[3]));
    layers[0].fillRow(1, row);
    EXPECT_TRUE(std::isnan(row[0]));
    EXPECT_EQ(row[3], 1.0f);
    std::vector<std::uint32_t> counts(2);
    layers[1].fillWholeRow(0, counts);
    EXPECT_EQ(counts, (std::vector{2u, 1u}));
    layers[1].fillWholeRow(1, counts);
    EXPECT_EQ(counts, (std::vector{0u, 3u}));
}

TEST(Film, ThereIsNoVarianceOfSingleSamples) {
    Film film({0, 1, 0, 1});
    film.pixels = {pixelOf({1.0f})};
    const std::vector<Layer> layers = filmLayers(film);
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].name, "samples");
}

} // namespace
} // namespace hyalite::core
