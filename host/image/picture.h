// Picture: the contents of an image file. Colours, layers and attributes.
#pragma once

#include "host/image/attribute.h"
#include "host/image/crop.h"
#include "host/image/image.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
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
    bool isLight = false; ///< colours, which 16-bit floats may hold
    /// The same, for whole numbers, which a file then has; fillRow may be empty.
    std::function<void(int y, std::span<std::uint32_t> row)> fillWholeRow{};
};

/// The projection of a picture, by the conventions of OpenEXR (ImfStandardAttributes.h) and RenderMan. Matrices are
/// stored row by row and multiply rows, (x y z 1) M, so that a translation is the last row. The world is that of the
/// scene's file.
///
///     camera: left-handed; x to the right, y up, z along the view      NDC: x, y of (0,0) top left to (1,1) bottom right
///                                                                       of the whole image, after division by w
struct Projection {
    std::array<double, 16> worldToCamera{};
    std::array<double, 16> worldToNdc{};
    double screenWindowWidth = 1.0; ///< of the image at the distance 1; 1 if it is not perspective
};

struct Picture {
    /*implicit*/ Picture(const Image &image)
        : colour(image), wholeWidth(image.width()),
          wholeHeight(image.height()), crop{0, image.width(), 0, image.height()} {}

    const Image &colour; ///< must outlive the picture
    /// Of each pixel of `colour`, in [0, 1], which then is premultiplied; must outlive the picture. Empty: opaque.
    std::span<const float> alpha{};
    int wholeWidth; ///< of the image that `crop` is part of, in pixels
    int wholeHeight;
    Crop crop; ///< of the size of `colour`
    std::vector<Layer> layers;
    std::vector<Attribute> attributes; ///< the origin of the picture
    std::optional<Projection> projection{};
};

} // namespace hyalite::core
