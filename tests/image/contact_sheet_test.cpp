// A contact sheet has its pictures pixel by pixel, in a grid, with a name above each.
#include "host/image/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

namespace hyalite::core {
namespace {

using Colour = std::array<std::uint8_t, 3>;

Colour at(const Drawing &drawing, int x, int y) {
    const auto *const pixel = drawing.rgb.data() + 3 * (y * drawing.width + x);
    return {pixel[0], pixel[1], pixel[2]};
}

/// The first pixel of that colour, or (-1, -1).
std::pair<int, int> firstOf(const Drawing &drawing, const Colour &colour) {
    for (int y = 0; y < drawing.height; ++y)
        for (int x = 0; x < drawing.width; ++x)
            if (at(drawing, x, y) == colour)
                return {x, y};
    return {-1, -1};
}

TEST(ContactSheet, IsAGridAboutAsWideAsHigh) {
    struct Grid {
        int count, columns, rows;
    };
    for (const Grid &grid :
         {Grid{1, 1, 1}, {2, 2, 1}, {3, 2, 2}, {4, 2, 2}, {5, 3, 2}, {9, 3, 3}, {10, 4, 3}}) {
        const SheetSize size = sheetSize(grid.count, 100, 50);
        EXPECT_EQ(size.columnCount, grid.columns) << grid.count;
        EXPECT_EQ(size.rowCount, grid.rows) << grid.count;
        EXPECT_GT(size.width, 100 * grid.columns);
        EXPECT_GT(size.height, 50 * grid.rows);
    }
}

TEST(ContactSheet, HasPicturesAsTheyAreInRows) {
    for (const int width : {40, 500}) {
        std::vector<SheetTile> tiles;
        const std::array<Colour, 3> colours{{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}};
        for (const Colour &colour : colours)
            tiles.push_back({"name", Drawing(width, 30, colour)});
        const Drawing sheet = drawSheet(tiles);
        EXPECT_EQ(sheet.width, sheetSize(3, width, 30).width);
        EXPECT_EQ(sheet.height, sheetSize(3, width, 30).height);
        for (const Colour &colour : colours) {
            int count = 0;
            for (int y = 0; y < sheet.height; ++y)
                for (int x = 0; x < sheet.width; ++x)
                    count += at(sheet, x, y) == colour ? 1 : 0;
            EXPECT_EQ(count, width * 30);
        }
        const auto [x0, y0] = firstOf(sheet, colours[0]);
        const auto [x1, y1] = firstOf(sheet, colours[1]);
        const auto [x2, y2] = firstOf(sheet, colours[2]);
        EXPECT_EQ(y1, y0);
        EXPECT_GT(x1, x0);
        EXPECT_EQ(x2, x0);
        EXPECT_GT(y2, y0 + 30);
        EXPECT_GE(y0, textHeight) << "there is room for the name";
    }
}

TEST(ContactSheet, NamesAreWrittenAboveAndNeverOverPictures) {
    const Drawing black(20, 10, {0, 0, 0});
    const Drawing named = drawSheet(std::vector<SheetTile>{{"a very long name", black}, {"b", black}});
    const Drawing other = drawSheet(std::vector<SheetTile>{{"another", black}, {"b", black}});
    EXPECT_NE(named.rgb, other.rgb);
    const auto [x, y] = firstOf(named, {0, 0, 0});
    for (int row = y; row < y + 10; ++row)
        for (int column = x; column < x + 20; ++column)
            EXPECT_EQ(at(named, column, row), (Colour{0, 0, 0}));
    std::set<Colour> above;
    for (int row = 0; row < y; ++row)
        for (int column = 0; column < named.width; ++column)
            above.insert(at(named, column, row));
    EXPECT_EQ(above.size(), 2u) << "letters on the sheet";
}

} // namespace
} // namespace hyalite::core
