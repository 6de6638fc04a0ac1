// Noise: its estimates against errors that are known, and how samples are shared out by it.
#include "host/film/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace hyalite::core {
namespace {

constexpr double darkness = 0.1;

/// A film of one crop, whose pixels get samples of a generator's. Their sums are those of a render.
class SampledFilm {
  public:
    SampledFilm(int width, int height, unsigned seed) : film_(Crop{0, width, 0, height}), random_(seed) {
        film_.first.resize(film_.pixels.size());
        film_.wanted.resize(film_.pixels.size());
    }

    using Sample = std::function<float(std::size_t pixel, std::mt19937 &random)>;

    /// Until each pixel has what it is to have.
    void add(const Sample &sample) {
        for (std::size_t i = 0; i < film_.pixels.size(); ++i) {
            layout::FilmPixel &pixel = film_.pixels[i];
            while (pixel.sampleCount < film_.wanted[i]) {
                if (pixel.sampleCount > 0 && pixel.sampleCount == std::bit_floor(film_.wanted[i] - 1))
                    film_.first[i] = {meanOf(pixel), pixel.sampleCount};
                const float value = sample(i, random_);
                pixel.sum += glm::vec3(value);
                pixel.sumOfSquares += glm::vec3(value * value);
                ++pixel.sampleCount;
            }
        }
    }

    [[nodiscard]] Film &film() { return film_; }
    [[nodiscard]] std::vector<NoiseBlock> blocks() const {
        return blocksInFilm(film_.crop, std::span(&film_.crop, 1));
    }

  private:
    Film film_;
    std::mt19937 random_;
};

constexpr NoiseTarget targetAt(double noise, std::uint32_t maxSamples = 1u << 16) {
    return {noise, darkness, maxSamples};
}

float gaussian(std::mt19937 &random, float mean, float deviation) {
    return std::normal_distribution<float>(mean, deviation)(random);
}

/// Renders until all blocks are finished; returns the number of rounds.
int finish(SampledFilm &sampled, const NoiseTarget &target, const SampledFilm::Sample &sample) {
    int rounds = 0;
    const std::vector<NoiseBlock> blocks = sampled.blocks();
    for (;; ++rounds) {
        const std::vector<BlockNoise> noises = beginRounds(sampled.film(), blocks, target);
        if (std::ranges::none_of(
                noises, [](const BlockNoise &block) { return block.state == BlockState::Unfinished; }))
            return rounds;
        sampled.add(sample);
    }
}

TEST(Noise, OfIndependentSamplesIsTheirError) {
    const auto sample = [](std::size_t, std::mt19937 &random) { return gaussian(random, 0.5f, 0.4f); };
    SampledFilm sampled(64, 64, 1);
    finish(sampled, targetAt(0.1), sample);
    double error = 0.0;
    for (const layout::FilmPixel &pixel : sampled.film().pixels)
        error += std::pow((sumOf(pixel).x / pixel.sampleCount - 0.5), 2.0) / (0.25 + darkness * darkness);
    error = std::sqrt(error / static_cast<double>(sampled.film().pixels.size()));
    const PictureNoise noise = noiseOf(sampled.film(), sampled.blocks(), targetAt(0.1));
    EXPECT_NEAR(noise.mean / error, 1.0,
                0.1); // neighbours' means are less than a pixel's own half of the time
    EXPECT_LE(noise.highest, 0.1);
    EXPECT_GT(noise.mean, 0.08); // no more samples than are needed
    EXPECT_EQ(noise.atTarget, 4u);
    EXPECT_EQ(noise.finishedPixels, 64u * 64u);
}

// Means of n samples whose variance is n^-1.5: the points of a net.
TEST(Noise, OfSamplesThatAreSpreadEvenlyIsLess) {
    Film film(Crop{0, 32, 0, 32});
    std::mt19937 random(5);
    constexpr std::uint32_t count = 64;
    const double all = 0.3 * std::pow(count, -0.75);
    const double first = 0.3 * std::pow(count / 2, -0.75);
    film.first.resize(film.pixels.size());
    film.wanted.assign(film.pixels.size(), count);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const float mean = gaussian(random, 1.0f, static_cast<float>(all));
        film.first[i] = {
            glm::vec3(gaussian(random, mean, static_cast<float>(std::sqrt(first * first - all * all)))),
            count / 2};
        film.pixels[i].sampleCount = count;
        film.pixels[i].sum = glm::vec3(mean * count);
        film.pixels[i].sumOfSquares = glm::vec3(static_cast<float>((mean * mean + 0.3 * 0.3) * count));
    }
    const std::vector<NoiseBlock> blocks = blocksInFilm(film.crop, std::span(&film.crop, 1));
    const double noise = noiseOf(film, blocks[0], targetAt(0.5)).noise;
    EXPECT_NEAR(noise * std::sqrt(1.01) / all, 1.0, 0.15);
    EXPECT_LT(noise, 0.5 * 0.3 / std::sqrt(count)); // as of independent samples
}

TEST(Noise, GivesNoisyPixelsMoreSamples) {
    const auto deviationAt = [](std::size_t pixel) { return pixel % 32 < 16 ? 0.05f : 0.5f; };
    const auto sample = [&](std::size_t pixel, std::mt19937 &random) {
        return gaussian(random, 1.0f, deviationAt(pixel));
    };
    SampledFilm sampled(32, 32, 2);
    finish(sampled, targetAt(0.05), sample);
    const Film &film = sampled.film();
    EXPECT_GE(film.pixels[31].sampleCount, 3 * film.pixels[0].sampleCount);
    EXPECT_EQ(film.pixels[0].sampleCount, film.wanted[0]);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) { // the first samples are known of each
        EXPECT_EQ(film.first[i].sampleCount, std::bit_floor(film.pixels[i].sampleCount - 1));
        EXPECT_GE(film.pixels[i].sampleCount, 16u);
    }
}

TEST(Noise, IsNotFooledByABrightPathInTheDark) {
    // One sample in 3,000 is bright: most pixels have none of them.
    const auto sample = [](std::size_t, std::mt19937 &random) {
        return std::uniform_real_distribution<float>()(random) < 1.0f / 3000.0f ? 300.0f : 0.1f;
    };
    SampledFilm sampled(32, 32, 3);
    beginRounds(sampled.film(), sampled.blocks(), targetAt(0.1));
    sampled.add(sample);
    EXPECT_GT(noiseOf(sampled.film(), sampled.blocks()[0], targetAt(0.1)).noise, 1.0);
}

// A lamp of one pixel, seen by all samples alike, has no noise however dark it is around it.
TEST(Noise, OfALampInTheDarkIsThatOfTheLamp) {
    const auto sample = [](std::size_t pixel, std::mt19937 &random) {
        return pixel == 500 ? gaussian(random, 100.0f, 5.0f) : 0.0f;
    };
    SampledFilm sampled(32, 32, 9);
    beginRounds(sampled.film(), sampled.blocks(), targetAt(0.1));
    sampled.add(sample);
    const double ofLamp = 0.05 / std::sqrt(16.0); // of 1,024 pixels
    EXPECT_LT(noiseOf(sampled.film(), sampled.blocks()[0], targetAt(0.1)).noise, 2.0 * ofLamp / 32.0);
}

TEST(Noise, RoundsDependOnNeitherTargetNorLimit) {
    const auto sample = [](std::size_t pixel, std::mt19937 &random) {
        return gaussian(random, 0.5f, pixel % 7 == 0 ? 0.6f : 0.1f);
    };
    SampledFilm low(32, 32, 4);
    SampledFilm high(32, 32, 4);
    for (int round = 0; round < 5; ++round) {
        beginRounds(low.film(), low.blocks(), targetAt(0.001));
        beginRounds(high.film(), high.blocks(), targetAt(0.01, 5000));
        EXPECT_EQ(low.film().wanted, high.film().wanted) << round;
        low.add(sample);
        high.add(sample);
    }
}

TEST(Noise, EndsAtTheLimit) {
    const auto sample = [](std::size_t, std::mt19937 &random) { return gaussian(random, 0.5f, 0.5f); };
    SampledFilm sampled(40, 33, 5); // with blocks that are cut
    const NoiseTarget target = targetAt(1e-3, 24);
    for (int round = 0; round < 10; ++round) {
        beginRounds(sampled.film(), sampled.blocks(), target);
        Film &film = sampled.film();
        const std::vector<std::uint32_t> wanted = film.wanted;
        for (std::uint32_t &count : film.wanted)
            count = std::min(count, target.maxSamples);
        sampled.add(sample);
        film.wanted = wanted;
    }
    const PictureNoise noise = noiseOf(sampled.film(), sampled.blocks(), target);
    EXPECT_EQ(noise.blockCount, 4u);
    EXPECT_EQ(noise.atLimit, 4u);
    EXPECT_EQ(noise.atTarget, 0u);
    EXPECT_EQ(noise.finishedPixels, 40u * 33u);
    EXPECT_TRUE(std::ranges::all_of(sampled.film().pixels,
                                    [](const auto &pixel) { return pixel.sampleCount <= 24; }));
}

TEST(Noise, IsZeroWhereNothingIsSeen) {
    SampledFilm sampled(32, 32, 6);
    finish(sampled, targetAt(1e-6), [](std::size_t, std::mt19937 &) { return 0.0f; });
    EXPECT_EQ(noiseOf(sampled.film(), sampled.blocks(), targetAt(1e-6)).highest, 0.0);
    EXPECT_EQ(sampled.film().pixels[5].sampleCount, 16u);
}

TEST(Noise, LeavesOutPixelsThatAreNotFinite) {
    const auto sample = [](std::size_t pixel, std::mt19937 &random) {
        return pixel == 40   ? std::numeric_limits<float>::quiet_NaN()
               : pixel == 50 ? std::numeric_limits<float>::infinity()
                             : gaussian(random, 0.5f, 0.2f);
    };
    SampledFilm sampled(32, 32, 7);
    EXPECT_LT(finish(sampled, targetAt(0.05), sample), 20);
    EXPECT_LE(noiseOf(sampled.film(), sampled.blocks(), targetAt(0.05)).highest, 0.05);
}

TEST(Noise, IsUnknownWithoutFirstSamples) {
    Film film(Crop{0, 4, 0, 4});
    const std::vector<NoiseBlock> blocks = blocksInFilm(film.crop, std::span(&film.crop, 1));
    EXPECT_TRUE(std::isinf(noiseOf(film, blocks[0], targetAt(0.1)).noise));
    EXPECT_EQ(noiseOf(film, blocks[0], targetAt(0.1)).state, BlockState::Unfinished);
}

// One pixel has no neighbours.
TEST(Noise, OfOnePixelIsItsOwn) {
    const auto sample = [](std::size_t, std::mt19937 &random) { return gaussian(random, 0.5f, 0.2f); };
    SampledFilm sampled(1, 1, 8);
    finish(sampled, targetAt(0.02), sample);
    EXPECT_GE(sampled.film().pixels[0].sampleCount, 48u);
    EXPECT_LE(noiseOf(sampled.film(), sampled.blocks(), targetAt(0.02)).highest, 0.02);
}

TEST(NoiseBlocks, AreThoseOfTheFilmAndOfItsParts) {
    const Crop crop{7, 107, 3, 90};
    const Partition partition(crop, 4, smallestSquare(0.1));
    Film film(crop);
    for (std::size_t i = 0; i < film.pixels.size(); ++i)
        film.pixels[i].sum.x = static_cast<float>(i);
    std::vector<int> cover(film.pixels.size(), 0);
    for (std::uint32_t part = 1; part <= 4; ++part) {
        const std::span<const Crop> squares = partition.squaresOf(part);
        const FilmRecords records = recordsIn(film, squares);
        const std::vector<NoiseBlock> whole = blocksInFilm(crop, squares);
        const std::vector<NoiseBlock> own = blocksInRecords(squares);
        ASSERT_EQ(whole.size(), own.size());
        for (std::size_t block = 0; block < whole.size(); ++block) {
            ASSERT_EQ(whole[block].pixelCount(), own[block].pixelCount());
            for (std::size_t i = 0; i < own[block].pixelCount(); ++i) {
                EXPECT_EQ(film.pixels[whole[block].indexOf(i)].sum.x,
                          records.pixels[own[block].indexOf(i)].sum.x);
                ++cover[whole[block].indexOf(i)];
            }
        }
    }
    EXPECT_TRUE(std::ranges::all_of(cover, [](int count) { return count == 1; }));
}

TEST(NoiseTarget, SeesDarknessByTheExposureInWholeStops) {
    RenderSettings settings;
    settings.noise = 0.02;
    settings.samplesPerPixel = 100;
    EXPECT_EQ(noiseTargetOf(settings).darkness, 0.1);
    EXPECT_EQ(noiseTargetOf(settings).maxSamples, 100u);
    settings.exposureStops = 2.4;
    EXPECT_EQ(noiseTargetOf(settings).darkness, 0.025);
    settings.exposureStops = -1.0;
    EXPECT_EQ(noiseTargetOf(settings).darkness, 0.2);
}

} // namespace
} // namespace hyalite::core
