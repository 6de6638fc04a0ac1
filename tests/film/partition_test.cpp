// Parts of a picture: each pixel is in one of them, and parts are alike.
#include "host/film/partition.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyalite::core {
namespace {

/// How often each pixel of the crop is in a part.
std::vector<int> coverOf(const Crop &crop, const Partition &partition) {
    std::vector<int> cover(Film(crop).pixels.size(), 0);
    for (std::uint32_t part = 1; part <= partition.partCount(); ++part)
        for (const Crop &square : partition.squaresOf(part))
            for (int y = square.y0; y < square.y1; ++y)
                for (int x = square.x0; x < square.x1; ++x)
                    ++cover.at(crop.indexOf(x, y));
    return cover;
}

TEST(Partition, HasEachPixelOnceForAnyCropAndNumberOfParts) {
    for (const Crop &crop : {Crop{0, 512, 0, 512}, Crop{3, 4, 7, 8}, Crop{5, 106, 11, 300},
                             Crop{0, 1, 0, 1000}, Crop{100, 1000, 0, 9}})
        for (const std::uint32_t wanted : {1u, 2u, 3u, 7u, 16u, 100u, 1000u}) {
            const std::uint32_t count = std::min(wanted, Partition::maxParts(crop));
            const Partition partition(crop, count);
            ASSERT_EQ(partition.partCount(), count);
            EXPECT_EQ(std::ranges::count(coverOf(crop, partition), 1), std::ssize(Film(crop).pixels))
                << count;
        }
}

TEST(Partition, OfOneIsTheWholeInOnePiece) {
    const Crop crop{5, 106, 11, 300};
    const Partition partition(crop, 1);
    ASSERT_EQ(partition.squaresOf(1).size(), 1u);
    EXPECT_EQ(partition.squaresOf(1)[0].width(), crop.width());
    EXPECT_EQ(partition.squaresOf(1)[0].height(), crop.height());
}

TEST(Partition, GivesPartsAsManyPixelsAndScattersThem) {
    const Crop crop{0, 1920, 0, 1080};
    for (const std::uint32_t count : {2u, 16u, 100u, 1000u}) {
        const Partition partition(crop, count);
        const double mean = 1920.0 * 1080.0 / count;
        for (std::uint32_t part = 1; part <= count; ++part) {
            EXPECT_GT(static_cast<double>(partition.pixelCountOf(part)), 0.85 * mean)
                << part << " of " << count;
            EXPECT_LT(static_cast<double>(partition.pixelCountOf(part)), 1.15 * mean);
            int quarters = 0; // of the picture in which it has a square
            for (const Crop &square : partition.squaresOf(part))
                quarters |= 1 << ((square.x0 < 960 ? 0 : 1) + (square.y0 < 540 ? 0 : 2));
            EXPECT_EQ(quarters, 15) << part << " of " << count;
        }
    }
}

TEST(Partition, IsTheSameEverywhere) {
    // Parts of one picture meet on machines with other compilers: the order is written down.
    const Partition partition({0, 256, 0, 256}, 4);
    std::uint64_t sum = 0;
    for (std::uint32_t part = 1; part <= 4; ++part)
        for (const Crop &square : partition.squaresOf(part))
            sum = sum * 1099511628211u + static_cast<std::uint64_t>(square.x0 * 1000 + square.y0);
    EXPECT_EQ(sum, 2802579275384643584u);
}

TEST(Partition, PixelsComeBackToTheirPlaces) {
    const Crop crop{5, 106, 11, 95};
    const Partition partition(crop, 5);
    Film film(crop);
    for (std::size_t i = 0; i < film.pixels.size(); ++i)
        film.pixels[i].sum.x = static_cast<float>(i);
    film.first.resize(film.pixels.size());
    for (std::size_t i = 0; i < film.first.size(); ++i)
        film.first[i] = {glm::vec3(0.5f), static_cast<std::uint32_t>(i)};
    Film copy(crop);
    for (std::uint32_t part = 1; part <= 5; ++part)
        setRecordsIn(copy, partition.squaresOf(part), recordsIn(film, partition.squaresOf(part)));
    EXPECT_EQ(differingPixelCount(copy, film), 0u);
    const Film masked = filmOfSquares(crop, partition.squaresOf(2), 9);
    EXPECT_EQ(std::ranges::count(masked.pixels, 9u, &layout::FilmPixel::sampleCount),
              std::ssize(film.pixels) - static_cast<std::ptrdiff_t>(partition.pixelCountOf(2)));
}

} // namespace
} // namespace hyalite::core
