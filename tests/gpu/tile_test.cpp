#include "host/gpu/tile.h"

#include <gtest/gtest.h>

#include <vector>

namespace hyalite::core::gpu {
namespace {

TEST(Tile, IsHalvedAcrossItsLongerSideIntoWholeBlocks) {
    const auto [left, right] = Tile{16, 24, 40, 16}.halves();
    EXPECT_EQ(left, (Tile{16, 24, 24, 16}));
    EXPECT_EQ(right, (Tile{40, 24, 16, 16}));
    const auto [upper, lower] = Tile{0, 8, 64, 64}.halves();
    EXPECT_EQ(upper, (Tile{0, 8, 64, 32}));
    EXPECT_EQ(lower, (Tile{0, 40, 64, 32}));
}

TEST(Tile, HalvesOfHalvesCoverAllBlocksOnce) {
    const Tile whole{8, 0, 56, 104};
    std::vector<int> covered(7 * 13);
    std::vector<Tile> waiting{whole};
    while (!waiting.empty()) {
        const Tile tile = waiting.back();
        waiting.pop_back();
        if (tile.canBeHalved()) {
            const auto [first, second] = tile.halves();
            EXPECT_EQ(first.pixelCount() + second.pixelCount(), tile.pixelCount());
            waiting.insert(waiting.end(), {first, second});
        } else {
            EXPECT_EQ(tile.pixelCount(), 64u);
            ++covered[tile.y / 8 * 7 + tile.x / 8 - 1];
        }
    }
    EXPECT_EQ(covered, std::vector<int>(7 * 13, 1));
}

} // namespace
} // namespace hyalite::core::gpu
