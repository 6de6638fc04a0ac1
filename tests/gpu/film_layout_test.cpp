// Layouts of films on a device: each pixel that wants samples is in one place, beside its neighbours.
#include "host/gpu/film_layout.h"

#include <gtest/gtest.h>

#include <numeric>

namespace hyalite::core::gpu {
namespace {

constexpr Crop crop{5, 105, 7, 67};

std::vector<layout::FilmPixel> filmWhere(const auto &isFinished) {
    std::vector<layout::FilmPixel> film(100 * 60);
    for (std::size_t i = 0; i < film.size(); ++i)
        film[i].sampleCount = isFinished(i) ? 8 : 3;
    return film;
}

TEST(FilmLayout, IsTheFilmWhereAllPixelsWantSamples) {
    for (const std::vector<layout::FilmPixel> &film :
         {std::vector<layout::FilmPixel>{}, filmWhere([](std::size_t) { return false; }),
          filmWhere([](std::size_t i) { return i % 64 == 0; })}) { // few are finished
        const FilmLayout layout(crop, film, 8);
        EXPECT_FALSE(layout.isGathered());
        EXPECT_EQ(layout.width(), 100u);
        EXPECT_EQ(layout.height(), 60u);
        EXPECT_EQ(layout.pixelCount(), 6000u);
    }
}

TEST(FilmLayout, GathersThePixelsThatWantSamples) {
    const auto isFinished = [](std::size_t i) { return i % 5 != 0 || i < 300; };
    const std::vector<layout::FilmPixel> film = filmWhere(isFinished);
    const FilmLayout layout(crop, film, 8);
    ASSERT_TRUE(layout.isGathered());
    EXPECT_LT(layout.pixelCount(), 6000u / 4);
    EXPECT_EQ(layout.width() % 8, 0u);
    EXPECT_EQ(layout.height() % 8, 0u);
    std::vector<int> seen(film.size(), 0);
    for (const std::uint32_t position : layout.positions())
        if (position != layout::noPosition)
            ++seen[((position >> 16u) - 7) * 100 + (position & 0xFFFFu) - 5];
    for (std::size_t i = 0; i < film.size(); ++i)
        EXPECT_EQ(seen[i], isFinished(i) ? 0 : 1) << i;
}

TEST(FilmLayout, ScattersWhatItGathered) {
    const std::vector<layout::FilmPixel> film = filmWhere([](std::size_t i) { return i % 3 != 0; });
    const FilmLayout layout(crop, film, 8);
    std::vector<float> values(2 * film.size());
    std::iota(values.begin(), values.end(), 1.0f);
    std::vector<float> device(2 * layout.pixelCount(), 0.0f);
    layout.gather<float>(values, 2, device);
    for (float &value : device)
        value = -value;
    std::vector<float> back = values;
    layout.scatter<float>(device, 2, back);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(back[i], i / 2 % 3 == 0 ? -values[i] : values[i]) << i;
}

TEST(FilmLayout, OfAFinishedFilmIsOneBlock) {
    const FilmLayout layout(crop, filmWhere([](std::size_t) { return true; }), 8);
    EXPECT_EQ(layout.pixelCount(), 64u);
    for (const std::uint32_t position : layout.positions())
        EXPECT_EQ(position, layout::noPosition);
}

} // namespace
} // namespace hyalite::core::gpu
