// Picture: the contents of an image file. Colours, layers and attributes.
#pragma once

#include "host/image/attribute.h"
#include "host/image/crop.h"
#include "host/image/image.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

/// A layer: values of each pixel beside its colour, such as its variance. Rows are requested one by one, so that a
/// layer need not be in memory as a whole.
struct Layer {
    std::string name;
    std::string channels; ///< a letter for each value of a pixel, such as RGB or XYZ; empty: one value
    /// Fills row y of the crop: pixel by pixel, all values of each.
    std::function<void(int y, std::span<float> row)> fillRow;
};

struct Picture {
    /*implicit*/ Picture(const Image &image)
        : colour(image), wholeWidth(image.width()),
          wholeHeight(image.height()), crop{0, image.width(), 0, image.height()} {}

    const Image &colour; ///< must outlive the picture
    int wholeWidth;      ///< of the image that `crop` is part of, in pixels
    int wholeHeight;
    Crop crop; ///< of the size of `colour`
    std::vector<Layer> layers;
    std::vector<Attribute> attributes; ///< the origin of the picture
};

} // namespace hyalite::core
