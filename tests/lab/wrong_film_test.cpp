// What differs in a wrong film, and which sample did it.
#include "host/lab/wrong_film.h"

#include "host/leaves/leaves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>

namespace hyalite::core {
namespace {

/// The pixel of these samples, as renderers add them.
layout::FilmPixel pixelOf(std::span<const glm::dvec3> values) {
    leaves::FilmPixel<float> sums(layout::FilmPixel{});
    for (const glm::dvec3 &value : values)
        sums = leaves::withSample<float>(sums, glm::vec3(value), 0.0f);
    layout::FilmPixel pixel{};
    pixel.sum = sums.sum;
    pixel.sumRest = sums.sumRest;
    pixel.sumOfSquares = sums.sumOfSquares;
    pixel.squaresRest = sums.squaresRest;
    pixel.sampleCount = static_cast<std::uint32_t>(values.size());
    return pixel;
}

std::vector<glm::dvec3> randomSamples(std::mt19937 &random, std::size_t count) {
    std::uniform_real_distribution<float> radiance(0.0f, 2.0f);
    std::vector<glm::dvec3> values(count);
    for (glm::dvec3 &value : values)
        value = glm::vec3(radiance(random), radiance(random), radiance(random));
    return values;
}

TEST(WrongFilm, NamesWordsAndBits) {
    layout::FilmPixel expected{};
    expected.sum.y = 1.0f;
    layout::FilmPixel found = expected;
    found.sum.y = std::bit_cast<float>(std::bit_cast<std::uint32_t>(1.0f) ^ 1u << 7);
    found.transparencyRest = 2.0f;
    const std::vector<WrongFilmWord> words = wrongWords(found, expected);
    ASSERT_EQ(words.size(), 2u);
    EXPECT_EQ(words[0], (WrongFilmWord{"sum.green", 0x3F800080u, 0x3F800000u}));
    EXPECT_EQ(words[1].name, "transparencyRest");
    WrongPatterns patterns;
    patterns.add(words[0]);
    EXPECT_EQ(patterns.bits[7], 1u);
    EXPECT_EQ(std::ranges::count(patterns.bits, 0u), 31);
}

TEST(WrongFilm, FindsTheSampleThatIsWrong) {
    std::mt19937 random(1);
    int found = 0;
    constexpr int trials = 1000;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<glm::dvec3> values = randomSamples(random, 16);
        const layout::FilmPixel expected = pixelOf(values);
        const std::vector<glm::dvec3> right = values;
        const std::uint32_t sample = static_cast<std::uint32_t>(random() % 16);
        const int channel = static_cast<int>(random() % 3);
        auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(values[sample][channel]));
        bits ^= 1u << (12 + random() % 11); // of the mantissa, but for bits that rounding of sums can hide
        values[sample][channel] = std::bit_cast<float>(bits);
        const std::vector<std::uint32_t> samples = samplesThatExplain(pixelOf(values), expected, right);
        if (!samples.empty()) { // a change that rounding hides in the squares has no explanation
            EXPECT_TRUE(std::ranges::find(samples, sample) != samples.end()) << trial;
            found += samples.size() == 1;
        }
    }
    EXPECT_GT(found, trials * 9 / 10);
}

TEST(WrongFilm, BlamesNoSampleForAFlippedSum) {
    std::mt19937 random(2);
    const std::vector<glm::dvec3> values = randomSamples(random, 16);
    const layout::FilmPixel expected = pixelOf(values);
    layout::FilmPixel found = expected;
    found.sum.x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(found.sum.x) ^ 1u << 20);
    EXPECT_TRUE(samplesThatExplain(found, expected, values).empty());
    found = expected;
    found.sampleCount ^= 1u;
    EXPECT_TRUE(samplesThatExplain(found, expected, values).empty());
}

} // namespace
} // namespace hyalite::core
