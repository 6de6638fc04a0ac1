// The denoiser: what it takes away, what it leaves, and what it does not depend on.
#include "host/reference/denoise.h"
#include "tests/fixtures/noisy_fixture.h"
#include "tests/fixtures/subnormals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace hyalite::core::testing {
namespace {

using reference::denoise;

std::size_t differingPixels(const Image &a, const Image &b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        count += std::memcmp(&a.pixels()[i], &b.pixels()[i], sizeof(glm::vec3)) != 0;
    return count;
}

double gainOf(const NoisyTruth &noisy) {
    return relativeMse(noisyImage(noisy.picture), noisy.truth) /
           relativeMse(denoise(noisy.picture), noisy.truth);
}

TEST(Denoiser, TakesMostNoiseFromAFlatWall) {
    EXPECT_GT(gainOf(makeNoisy(64, 48, 8, 16, 1, [](int, int) { return Truth{}; })), 15.0);
}

// Albedo, normals and depth each tell the edges of what a pixel shows; without them, the colours do.
TEST(Denoiser, KeepsTheEdgesThatFeaturesShow) {
    const auto stripes = [](auto change) {
        return makeNoisy(64, 48, 8, 16, 2, [change](int x, int) {
            Truth truth;
            if (x / 6 % 2 == 0) {
                truth.colour *= 0.3f;
                change(truth);
            }
            return truth;
        });
    };
    EXPECT_GT(gainOf(stripes([](Truth &truth) { truth.albedo *= 0.3f; })), 6.0);
    EXPECT_GT(gainOf(stripes([](Truth &truth) { truth.normal = {1.0f, 0.0f, 0.0f}; })), 6.0);
    EXPECT_GT(gainOf(stripes([](Truth &truth) { truth.depth = 9.0f; })), 6.0);
    EXPECT_GT(gainOf(stripes([](Truth &) {})), 4.0); // as of a shadow or a reflection
}

TEST(Denoiser, FollowsGradients) { EXPECT_GT(gainOf(makeNoisyRoom(96, 64)), 3.5); }

TEST(Denoiser, TakesAnyShareOfFirstSamples) {
    for (const auto &[first, samples] :
         {std::pair{2, 4}, std::pair{4, 5}, std::pair{16, 24}, std::pair{32, 64}})
        EXPECT_GT(gainOf(makeNoisyRoom(96, 64, first, samples)), 3.0) << first << " of " << samples;
}

// Those that are darker than what is beside them may have missed a light.
TEST(Denoiser, LeavesPixelsWithoutNoiseAsTheyAre) {
    const NoisyTruth noisy = makeNoisyRoom(96, 64);
    const Image image = denoise(noisy.picture);
    for (int y = 0; y < 40; ++y)
        for (int x = 47; x < 50; ++x)
            for (int channel = 0; channel < 3; ++channel) {
                const float truth = noisy.truth[static_cast<std::size_t>(y * 96 + x)][channel];
                if (x == 48) {
                    ASSERT_FLOAT_EQ(image.at(x, y)[channel], truth);
                }
                ASSERT_NEAR(image.at(x, y)[channel], truth, 5e-3f);
            }
}

// A pixel all samples of which have missed a light has no variance; it is no detail.
TEST(Denoiser, TakesAwayPixelsThatHaveMissedALight) {
    NoisyTruth noisy = makeNoisy(32, 32, 2, 4, 3, [](int, int) { return Truth{.rarity = 0.5f}; });
    const glm::vec3 elsewhere(0.05f); // light that all samples see
    for (layout::NoisyPixel &pixel : noisy.picture.pixels) {
        pixel.colour += elsewhere;
        pixel.first += elsewhere;
    }
    const auto countDark = [](const Image &image) {
        return std::ranges::count_if(image.pixels(), [](const glm::vec3 &colour) { return colour.x < 0.1f; });
    };
    EXPECT_GT(countDark(noisyImage(noisy.picture)), 30);
    EXPECT_LT(countDark(denoise(noisy.picture)), 3);
}

// Where few samples bring most of the light, pixels side by side that have missed it agree, as if they had no noise, and
// those that have met it in both halves seem to be lamps.
TEST(Denoiser, IsNotMisledByRareLight) {
    EXPECT_GT(gainOf(makeNoisy(120, 120, 8, 16, 3,
                               [](int, int) { return Truth{.rarity = 0.02f, .rareShare = 0.6f}; })),
              50.0);
}

/// A flat wall with a pixel of this colour and first half.
Image withHotPixel(float colour, float first) {
    NoisyTruth noisy = makeNoisy(32, 32, 8, 16, 3, [](int, int) { return Truth{.spread = 0.5f}; });
    layout::NoisyPixel &pixel = noisy.picture.pixels[16 * 32 + 16];
    pixel.colour = glm::vec3(colour);
    pixel.first = glm::vec3(first);
    pixel.variance = glm::vec3(colour * colour * (first == colour ? 0.01f : 1.0f));
    return denoise(noisy.picture);
}

TEST(Denoiser, TakesAwayWhatOneSampleHasSeenAlone) {
    const Image image = withHotPixel(100.0f, 200.0f);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            EXPECT_NEAR(image.at(x, y).x, 0.5f, 0.25f) << x << ' ' << y;
}

TEST(Denoiser, KeepsASmallLampThatBothHalvesSee) {
    const Image image = withHotPixel(100.0f, 100.0f);
    EXPECT_GT(image.at(16, 16).x, 50.0f);
    EXPECT_NEAR(image.at(20, 16).x, 0.5f, 0.25f);
}

TEST(Denoiser, DependsNeitherOnTilesNorOnThreads) {
    const NoisyPicture picture = makeNoisyRoom(150, 70).picture;
    const Image whole = denoise(picture, 1);
    EXPECT_EQ(differingPixels(whole, denoise(picture, 5)), 0u);
    for (const int side : {11, 64})
        EXPECT_EQ(differingPixels(whole, denoise(picture, 2, side)), 0u) << side;
}

TEST(Denoiser, DoesNotDependOnExposure) {
    NoisyPicture picture = makeNoisyRoom(96, 64).picture;
    Image expected = denoise(picture);
    for (const float factor : {0x1p-30f, 0x1p20f}) {
        NoisyPicture other = picture;
        for (layout::NoisyPixel &pixel : other.pixels) {
            pixel.colour *= factor;
            pixel.first *= factor;
            pixel.variance *= factor * factor;
        }
        Image image = denoise(other);
        for (glm::vec3 &colour : image.pixels())
            colour /= factor;
        EXPECT_EQ(differingPixels(image, expected), 0u) << factor;
    }
}

// What is no number, or beyond all measure, stays where it is and as it is.
TEST(Denoiser, LeavesFaultyPixelsAlone) {
    const NoisyPicture clean = makeNoisyRoom(48, 32).picture;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
    for (const float fault : {notANumber, infinity, -infinity, -1.0f, 1e38f}) {
        NoisyPicture picture = clean;
        layout::NoisyPixel &pixel = picture.pixels[10 * 48 + 30];
        pixel.colour.y = fault;
        pixel.first.y = fault;
        pixel.variance.y = std::abs(fault);
        pixel.albedo.x = fault;
        pixel.normal.z = fault;
        pixel.depth = fault;
        const Image image = denoise(picture);
        EXPECT_EQ(std::memcmp(&image.at(30, 10), &pixel.colour, sizeof(glm::vec3)), 0) << fault;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 48; ++x)
                ASSERT_TRUE((x == 30 && y == 10) ||
                            (std::isfinite(image.at(x, y).y) && image.at(x, y).y < 20.0f))
                    << fault << ' ' << x << ' ' << y;
    }
}

TEST(Denoiser, TakesAnySize) {
    for (const auto &[width, height] : {std::pair{1, 1}, std::pair{1, 40}, std::pair{3, 2}}) {
        const Image image = denoise(makeNoisyRoom(width, height).picture);
        EXPECT_EQ(image.width(), width);
        EXPECT_EQ(image.height(), height);
        for (const glm::vec3 &colour : image.pixels())
            EXPECT_TRUE(std::isfinite(colour.x + colour.y + colour.z));
    }
}

TEST(Denoiser, LeavesABlackPictureBlack) {
    const auto black = [](int, int) { return Truth{.colour = glm::vec3(0.0f)}; };
    const Image image = denoise(makeNoisy(20, 20, 8, 16, 4, black).picture);
    for (const glm::vec3 &colour : image.pixels())
        EXPECT_EQ(colour, glm::vec3(0.0f));
}

TEST(Denoiser, HasNoBitThatSubnormalNumbersDecide) {
    for (const float darkness : {1.0f, 1e-12f, 1e-30f, 1e-37f}) {
        const NoisyTruth noisy = makeNoisy(40, 30, 8, 16, 5, [darkness](int x, int y) {
            Truth truth;
            truth.colour = glm::vec3((x / 10 + y / 10) % 2 == 0 ? darkness : 1.0f);
            truth.albedo =
                glm::vec3(0.5f + static_cast<float>(x) * 1e-20f, static_cast<float>(y) * darkness, 0.1f);
            return truth;
        });
        const auto image = [&] { return denoise(noisy.picture, 1); };
        EXPECT_EQ(differingPixels(image(), withSubnormalsFlushed(image)), 0u) << darkness;
    }
}

} // namespace
} // namespace hyalite::core::testing
