// Which tiles of a picture a spot check renders.
#include "host/engine/spot_check.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace hyalite::core {
namespace {

TEST(SpotCheck, StaysInsideTheCrop) {
    for (int width = 1; width < 70; ++width)
        for (const int height : {1, 7, 8, 9, 31, 64}) {
            const Crop crop{5, 5 + width, 11, 11 + height};
            const std::vector<Crop> spots = spotsIn(crop);
            ASSERT_FALSE(spots.empty());
            std::set<std::pair<int, int>> corners;
            for (const Crop &spot : spots) {
                EXPECT_TRUE(spot.x0 >= crop.x0 && spot.x0 < spot.x1 && spot.x1 <= crop.x1);
                EXPECT_TRUE(spot.y0 >= crop.y0 && spot.y0 < spot.y1 && spot.y1 <= crop.y1);
                EXPECT_TRUE(spot.width() <= 8 && spot.height() <= 8);
                EXPECT_TRUE(corners.emplace(spot.x0 / 8, spot.y0 / 8).second) << "they overlap";
            }
        }
}

TEST(SpotCheck, LooksAtFourPlacesOfALargePicture) {
    EXPECT_EQ(spotsIn({0, 1000, 0, 500}),
              (std::vector<Crop>{
                  {496, 504, 248, 256}, {496, 504, 400, 408}, {240, 248, 168, 176}, {760, 768, 168, 176}}));
    EXPECT_EQ(spotsIn({0, 8, 0, 8}).size(), 1u);
}

} // namespace
} // namespace hyalite::core
