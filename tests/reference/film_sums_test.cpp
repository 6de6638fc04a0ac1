// The sums of a film, which do not drift (shaders/math/sums.glsl).
#include "host/film/film.h"
#include "host/reference/scene_view.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace hyalite::core::reference {
namespace {

layout::FilmPixel pixelOf(const FilmPixel<float> &sums, std::uint32_t count) {
    auto pixel = std::bit_cast<layout::FilmPixel>(sums);
    pixel.sampleCount = count;
    return pixel;
}

TEST(FilmSums, OfAConstantStayWhereTheyAre) {
    const glm::vec3 constant(0.1f, 0.001f, 10000.0f);
    FilmPixel<float> sums(layout::FilmPixel{});
    for (std::uint32_t count = 1; count <= 1'000'000; ++count) {
        sums = withSample<float>(sums, constant, 0.3f);
        if (count != 65'536 && count != 1'000'000)
            continue;
        const layout::FilmPixel pixel = pixelOf(sums, count);
        EXPECT_NEAR(alphaOf(pixel), 0.7f, 1e-6f) << count;
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(meanOf(pixel)[channel] / constant[channel], 1.0f, 1e-6f) << count;
            const double squared = static_cast<double>(constant[channel]) * constant[channel];
            EXPECT_LE(varianceOfMean(pixel)[channel] * count, 1e-7 * squared) << count;
        }
    }
}

TEST(FilmSums, LoseNothingToASampleThatIsLargerThanAllBefore) {
    FilmPixel<float> sums(layout::FilmPixel{});
    for (const float sample : {1e-3f, 1e7f, 1e-3f})
        sums = withSample<float>(sums, glm::vec3(sample), 0.0f);
    EXPECT_NEAR(sumOf(pixelOf(sums, 3)).x, 1e7 + 2e-3, 1e-9);
}

TEST(FilmSums, DoNotChangeByBlackSamples) {
    FilmPixel<float> sums(layout::FilmPixel{});
    for (int i = 0; i < 1000; ++i) {
        sums = withSample<float>(
            sums, glm::vec3(0.1f * static_cast<float>(i), 1e9f / static_cast<float>(i + 1), 3.0f), 0.0f);
        const layout::FilmPixel before = pixelOf(sums, 1);
        sums = withSample<float>(sums, glm::vec3(0.0f), 0.0f);
        EXPECT_TRUE(haveEqualBits({{before}}, {{pixelOf(sums, 1)}}, 0)) << i;
    }
}

TEST(FilmSums, StayInfinite) {
    FilmPixel<float> sums(layout::FilmPixel{});
    for (const float sample : {1.0f, std::numeric_limits<float>::infinity(), 1.0f})
        sums = withSample<float>(sums, glm::vec3(sample), 0.0f);
    EXPECT_EQ(meanOf(pixelOf(sums, 3)).x, std::numeric_limits<float>::infinity());
}

} // namespace
} // namespace hyalite::core::reference
