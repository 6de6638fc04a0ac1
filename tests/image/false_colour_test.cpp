#include "host/image/false_colour.h"

#include "host/image/heat_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace hyalite::core {
namespace {

using Colour = std::array<std::uint8_t, 3>;

Colour colourAt(const Drawing &drawing, int x, int y) {
    const auto begin = drawing.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * drawing.width + x);
    return {begin[0], begin[1], begin[2]};
}

TEST(ScaleEnd, IsARoundNumberThatAlmostAllValuesReach) {
    const auto endFor = [](float value) { return scaleEndFor(std::array{value}); };
    EXPECT_DOUBLE_EQ(endFor(0.0f), 1.0);
    EXPECT_DOUBLE_EQ(endFor(1.0f), 1.0);
    EXPECT_DOUBLE_EQ(endFor(1.6f), 2.0);
    EXPECT_DOUBLE_EQ(endFor(2.1f), 3.0);
    EXPECT_DOUBLE_EQ(endFor(999.0f), 1000.0);
    EXPECT_DOUBLE_EQ(endFor(1000.0f), 1000.0);
    EXPECT_DOUBLE_EQ(endFor(1001.0f), 1500.0);
    EXPECT_DOUBLE_EQ(endFor(0.045f), 0.05);
    EXPECT_DOUBLE_EQ(scaleEndFor({}), 1.0);
    std::vector<float> values(1000, 7.0f);
    values[500] = 1e6f; // one in a thousand
    EXPECT_DOUBLE_EQ(scaleEndFor(values), 8.0);
    std::fill(values.begin(), values.begin() + 11, 1e6f);
    EXPECT_DOUBLE_EQ(scaleEndFor(values), 1e6);
}

TEST(FalseColours, AreThoseOfTheHeatMapAboveALegend) {
    constexpr int width = 500;
    constexpr int height = 20;
    std::vector<float> values(width * height);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(i % 101); // a scale to 100
    const Drawing drawing = falseColours(width, height, values, "things");
    EXPECT_EQ(drawing.width, width);
    EXPECT_GT(drawing.height, height + 2 * textHeight);
    EXPECT_EQ(drawing.rgb.size(), 3u * width * static_cast<unsigned>(drawing.height));
    for (const int x : {0, 50, 100, 499})
        EXPECT_EQ(colourAt(drawing, x, 3), magma(values[static_cast<std::size_t>(3 * width + x)] / 100.0f));
    // The bar has all the colours, in order.
    std::vector<Colour> bar;
    for (int x = 0; x < width; ++x)
        if (colourAt(drawing, x, height + 24) != colourAt(drawing, 0, height + 24))
            bar.push_back(colourAt(drawing, x, height + 24));
    ASSERT_GT(bar.size(), 400u);
    EXPECT_EQ(bar.front(), magma(0.0f));
    EXPECT_EQ(bar.back(), magma(1.0f));
}

TEST(FalseColours, SmallDrawingsHaveALegendToo) {
    const Drawing drawing = falseColours(1, 1, std::array{3.0f}, "box and triangle tests per sample");
    EXPECT_GE(drawing.width, textWidth("box and triangle tests per sample; most: 3", 1));
    EXPECT_EQ(colourAt(drawing, drawing.width / 2, 0), magma(1.0f));
    EXPECT_NE(colourAt(drawing, 0, 0), magma(1.0f));
}

TEST(DrawText, StaysInItsBoxAndScales) {
    const std::string text = "0123456789 box and triangle, (ms): gjpqy";
    const Colour white{255, 255, 255};
    const Colour black{0, 0, 0};
    const auto draw = [&](int scale) {
        Drawing drawing(textWidth(text, scale) + 4 * scale, (textHeight + 4) * scale, black);
        drawText(drawing, 2 * scale, 2 * scale, scale, text, white);
        return drawing;
    };
    const Drawing once = draw(1);
    const Drawing twice = draw(2);
    int inkCount = 0;
    for (int y = 0; y < once.height; ++y)
        for (int x = 0; x < once.width; ++x) {
            EXPECT_EQ(colourAt(once, x, y), colourAt(twice, 2 * x, 2 * y));
            EXPECT_EQ(colourAt(once, x, y), colourAt(twice, 2 * x + 1, 2 * y + 1));
            const bool isInside = x >= 2 && x < once.width - 2 && y >= 2 && y < once.height - 2;
            EXPECT_TRUE(isInside || colourAt(once, x, y) == black) << x << " " << y;
            inkCount += colourAt(once, x, y) == white ? 1 : 0;
        }
    EXPECT_GT(inkCount, 300);
    Drawing tiny(3, 3, black);
    drawText(tiny, -5, -5, 3, text, white); // what lies outside is left out
}

} // namespace
} // namespace hyalite::core
