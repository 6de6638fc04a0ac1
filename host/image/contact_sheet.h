// Contact sheet: pictures of one size in a grid, each with its name above it.
#pragma once

#include "host/image/bitmap_text.h"

#include <span>
#include <string>

namespace hyalite::core {

struct SheetTile {
    std::string name; ///< printable ASCII
    Drawing picture;
};

/// Row by row, as wide as high or wider by one picture at most; pictures are not scaled. There is at least one.
[[nodiscard]] Drawing drawSheet(std::span<const SheetTile> tiles);

/// The size of a sheet of `count` pictures.
struct SheetSize {
    int columnCount = 0;
    int rowCount = 0;
    int width = 0; ///< pixels
    int height = 0;
};
[[nodiscard]] SheetSize sheetSize(int count, int pictureWidth, int pictureHeight);

} // namespace hyalite::core
