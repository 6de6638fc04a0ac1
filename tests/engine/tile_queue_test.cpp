// The queue of tiles that several renderers share.
#include "host/engine/tile_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hyalite::core {
namespace {

/// How often each pixel of the film is in one of the tiles.
std::vector<int> coverage(const Film &film, const std::vector<Crop> &tiles) {
    std::vector<int> counts(film.pixels.size());
    for (const Crop &tile : tiles)
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                ++counts[film.crop.indexOf(x, y)];
    return counts;
}

TEST(TileQueue, GivesEachPixelOnce) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> side(1, 300);
    std::uniform_int_distribution<std::uint64_t> size(1, 20'000);
    for (int time = 0; time < 50; ++time) {
        const Film film(Crop{7, 7 + side(random), 3, 3 + side(random)});
        TileQueue queue(film, 1);
        EXPECT_EQ(queue.pixelCount(), film.pixels.size());
        std::vector<Crop> tiles;
        for (;;) {
            const std::uint64_t most = size(random);
            const std::optional<Crop> tile = queue.take(most);
            if (!tile)
                break;
            EXPECT_LE(tile->pixelCount(), std::max<std::uint64_t>(most, 64));
            EXPECT_GT(tile->pixelCount(), 0u);
            tiles.push_back(*tile);
        }
        EXPECT_EQ(queue.pixelCount(), 0u);
        EXPECT_TRUE(std::ranges::all_of(coverage(film, tiles), [](int count) { return count == 1; }));
    }
}

TEST(TileQueue, GivesBlocksOfWorkgroups) {
    TileQueue queue(Film(Crop{0, 100, 0, 100}), 1);
    while (const std::optional<Crop> tile = queue.take(500)) {
        EXPECT_TRUE(tile->width() % 8 == 0 || tile->x1 == 100);
        EXPECT_TRUE(tile->height() % 8 == 0 || tile->y1 == 100);
    }
}

TEST(TileQueue, LeavesFinishedPixelsOut) {
    Film film(Crop{0, 256, 0, 256});
    for (std::size_t i = 0; i < film.pixels.size(); ++i)
        film.pixels[i].sampleCount = i % 256 < 192 ? 4 : 3; // three quarters, from the left
    TileQueue queue(film, 4);
    EXPECT_EQ(queue.pixelCount(), 64u * 256u);
    while (const std::optional<Crop> tile = queue.take(1000))
        EXPECT_GE(tile->x0, 192);
    EXPECT_EQ(TileQueue(film, 3).take(1000), std::nullopt);
}

TEST(TileQueue, GivesWhatCameBackNext) {
    TileQueue queue(Film(Crop{0, 64, 0, 64}), 1);
    const std::optional<Crop> first = queue.take(256);
    ASSERT_TRUE(first);
    EXPECT_NE(queue.take(256), first);
    queue.giveBack(*first);
    EXPECT_EQ(queue.take(256), first);
}

TEST(TilePixels, AreAShareOfTheRestWithinBounds) {
    TileWish wish{10.0, 1e6, 4e6, 1e9, 640'000.0}; // 100,000 pixels a second, a quarter of all
    EXPECT_EQ(tilePixels(wish), 10'000u);          // a sixteenth of a quarter
    wish.waitingPixels = 1e9;
    EXPECT_EQ(tilePixels(wish), 200'000u); // two seconds
    wish.waitingPixels = 1000.0;
    EXPECT_EQ(tilePixels(wish), 5000u); // a twentieth of a second
    wish.allSamplesPerSecond = 1e6;     // alone
    wish.waitingPixels = 70'000.0;
    EXPECT_EQ(tilePixels(wish), 70'000u);
    wish.lastSamples = 1000.0;
    EXPECT_EQ(tilePixels(wish), 800u); // eight times the last one
    wish.lastSamples = 1.0;
    EXPECT_EQ(tilePixels(wish), 64u);
    wish.samplesPerSecond = 0.0;
    EXPECT_EQ(tilePixels(wish), 4096u);
    wish.samplesPerPixel = 1024.0;
    EXPECT_EQ(tilePixels(wish), 64u);
}

} // namespace
} // namespace hyalite::core
