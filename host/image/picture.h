// All that an image file can hold of a render: colours, what is known beside them, and where they come from.
#pragma once

#include "host/image/attribute.h"
#include "host/image/crop.h"
#include "host/image/image.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hyalite {

/// Values of each pixel beside its colour, such as its variance. They are asked for row by row, so that a layer need
/// not be in memory as a whole.
struct Layer {
    std::string name;
    std::string channels; ///< a letter for each value of a pixel, such as RGB or XYZ; empty: one value
    std::function<void(int y, std::span<float> row)>
        fillRow; ///< row y of the crop: pixel by pixel, all values of each
};

struct Picture {
    /*implicit*/ Picture(const Image &image)
        : colour(image), wholeWidth(image.width()),
          wholeHeight(image.height()), crop{0, image.width(), 0, image.height()} {}

    const Image &colour; ///< must outlive the picture
    int wholeWidth;      ///< of the image that `crop` is a part of, pixels
    int wholeHeight;
    Crop crop; ///< of the size of `colour`
    std::vector<Layer> layers;
    std::vector<Attribute> attributes; ///< what made the picture, from what
};

} // namespace hyalite
