// The film: what both renderers fill, one record a pixel of the crop.
#pragma once

#include "host/image/image.h"
#include "shaders/layout.h"

#include <vector>

namespace hyalite {

/// A rectangle of pixels of the whole image, half open: x0 <= x < x1, y0 <= y < y1.
struct Crop {
    int x0 = 0;
    int x1 = 0;
    int y0 = 0;
    int y1 = 0;

    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
};

struct Film {
    Crop crop;
    std::vector<layout::FilmPixel> pixels; ///< row by row from the top left

    explicit Film(const Crop &region)
        : crop(region),
          pixels(static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height())) {}

    /// The mean of the samples of each pixel; black where there is none.
    [[nodiscard]] Image toImage() const {
        Image image(crop.width(), crop.height());
        for (std::size_t i = 0; i < pixels.size(); ++i)
            if (pixels[i].sampleCount > 0)
                image.pixels()[i] = pixels[i].sum / static_cast<float>(pixels[i].sampleCount);
        return image;
    }
};

} // namespace hyalite
