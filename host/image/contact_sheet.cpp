#include "host/image/contact_sheet.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hyalite::core {

namespace {

constexpr std::array<std::uint8_t, 3> sheetColour{32, 32, 32};
constexpr std::array<std::uint8_t, 3> labelColour{224, 224, 224};
constexpr int gap = 4;                ///< pixels between pictures, and around them
constexpr int largePicture = 400;     ///< from this width on, letters have twice the size
constexpr int spaceAroundLetters = 2; ///< times their scale, above and below

int textScale(int pictureWidth) { return pictureWidth >= largePicture ? 2 : 1; }

int labelHeight(int pictureWidth) { return textScale(pictureWidth) * (textHeight + 2 * spaceAroundLetters); }

void paste(const Drawing &picture, int x, int y, Drawing &sheet) {
    const auto offset = [](const Drawing &drawing, int column, int row) {
        return std::ptrdiff_t{3} * (std::ptrdiff_t{row} * drawing.width + column);
    };
    for (int row = 0; row < picture.height; ++row)
        std::copy_n(picture.rgb.begin() + offset(picture, 0, row), 3 * picture.width,
                    sheet.rgb.begin() + offset(sheet, x, y + row));
}

} // namespace

SheetSize sheetSize(int count, int pictureWidth, int pictureHeight) {
    assert(count >= 1);
    SheetSize size;
    size.columnCount = static_cast<int>(std::ceil(std::sqrt(count)));
    size.rowCount = (count + size.columnCount - 1) / size.columnCount;
    size.width = gap + size.columnCount * (pictureWidth + gap);
    size.height = gap + size.rowCount * (labelHeight(pictureWidth) + pictureHeight + gap);
    return size;
}

Drawing drawSheet(std::span<const SheetTile> tiles) {
    const int width = tiles.front().picture.width;
    const int height = tiles.front().picture.height;
    const SheetSize size = sheetSize(static_cast<int>(tiles.size()), width, height);
    const int scale = textScale(width);
    Drawing sheet(size.width, size.height, sheetColour);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const int column = static_cast<int>(i) % size.columnCount;
        const int row = static_cast<int>(i) / size.columnCount;
        const int x = gap + column * (width + gap);
        const int y = gap + row * (labelHeight(width) + height + gap);
        drawText(sheet, x, y + scale * spaceAroundLetters, scale, tiles[i].name, labelColour);
        paste(tiles[i].picture, x, y + labelHeight(width), sheet); // over letters that are too long
    }
    return sheet;
}

} // namespace hyalite::core
