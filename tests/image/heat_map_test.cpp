#include "host/image/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hyalite::core {
namespace {

TEST(HeatMap, IsNearTheOriginalTable) {
    // Entries of matplotlib's "magma", as 8-bit levels.
    const struct {
        int index;
        std::array<int, 3> colour;
    } entries[] = {{0, {0, 0, 4}},        {64, {81, 18, 124}},    {100, {137, 40, 129}},
                   {128, {183, 55, 121}}, {200, {253, 152, 105}}, {255, {252, 253, 191}}};
    for (const auto &entry : entries) {
        const auto colour = magma(static_cast<float>(entry.index) / 255.0f);
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(colour[channel], entry.colour[channel], 3) << entry.index;
    }
}

TEST(HeatMap, GetsBrighterWithTheError) {
    double last = -1.0;
    for (int i = 0; i <= 64; ++i) {
        const auto colour = magma(static_cast<float>(i) / 64.0f);
        const double luminance = 0.2126 * std::pow(colour[0] / 255.0, 2.2) +
                                 0.7152 * std::pow(colour[1] / 255.0, 2.2) +
                                 0.0722 * std::pow(colour[2] / 255.0, 2.2);
        EXPECT_GT(luminance, last) << i;
        last = luminance;
    }
}

TEST(HeatMap, ClampsWhatIsNoError) {
    EXPECT_EQ(magma(-1.0f), magma(0.0f));
    EXPECT_EQ(magma(2.0f), magma(1.0f));
    EXPECT_EQ(magma(std::numeric_limits<float>::quiet_NaN()), magma(1.0f));
    EXPECT_EQ(magma(std::numeric_limits<float>::infinity()), magma(1.0f));
}

TEST(HeatMap, HasThreeBytesAPixel) {
    EXPECT_EQ(heatMap({2, 1, {0.0f, 1.0f}}), (std::vector<std::uint8_t>{0, 0, 4, 252, 253, 191}));
}

} // namespace
} // namespace hyalite::core
