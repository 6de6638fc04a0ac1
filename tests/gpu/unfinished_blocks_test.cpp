// Blocks of a film that want more samples.
#include "host/gpu/unfinished_blocks.h"

#include <gtest/gtest.h>

#include <random>

namespace hyalite::core::gpu {
namespace {

TEST(UnfinishedBlocks, AreCountedInAnyTile) {
    std::mt19937 random(1);
    constexpr std::uint32_t width = 61; // blocks at the edges are cut
    constexpr std::uint32_t height = 43;
    std::vector<layout::FilmPixel> film(width * height);
    for (layout::FilmPixel &pixel : film)
        pixel.sampleCount = random() % 40 == 0 ? 3 : 4;
    const UnfinishedBlocks blocks(film, width, height, 4);
    const auto isUnfinished = [&](std::uint32_t column, std::uint32_t row) {
        for (std::uint32_t y = 8 * row; y < std::min(8 * row + 8, height); ++y)
            for (std::uint32_t x = 8 * column; x < std::min(8 * column + 8, width); ++x)
                if (film[y * width + x].sampleCount < 4)
                    return true;
        return false;
    };
    for (int time = 0; time < 100; ++time) {
        const auto upTo = [&](std::uint32_t most) { return 8 * static_cast<std::uint32_t>(random() % most); };
        const Tile tile{upTo(9), upTo(7), 8 + upTo(9), 8 + upTo(7)};
        std::uint64_t unfinished = 0;
        std::uint64_t all = 0;
        for (std::uint32_t row = tile.y / 8; row < std::min((tile.y + tile.height) / 8, 6u); ++row)
            for (std::uint32_t column = tile.x / 8; column < std::min((tile.x + tile.width) / 8, 8u);
                 ++column) {
                unfinished += isUnfinished(column, row);
                ++all;
            }
        EXPECT_EQ(blocks.in(tile).unfinished, unfinished);
        EXPECT_EQ(blocks.in(tile).all, all);
    }
}

TEST(UnfinishedBlocks, AreAllOfAFilmThatIsNotBegun) {
    const UnfinishedBlocks::Count count = UnfinishedBlocks({}, 20, 20, 1).in({0, 0, 512, 512});
    EXPECT_EQ(count.unfinished, 9u);
    EXPECT_EQ(count.all, 9u);
}

} // namespace
} // namespace hyalite::core::gpu
