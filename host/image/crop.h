// Crop: a part of an image.
#pragma once

#include <cstddef>

namespace hyalite::core {

/// A rectangle of pixels of the whole image, half open: x0 <= x < x1, y0 <= y < y1.
struct Crop {
    int x0 = 0;
    int x1 = 0;
    int y0 = 0;
    int y1 = 0;

    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
    [[nodiscard]] std::size_t pixelCount() const {
        return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
    }
    /// Of a pixel of the whole image that is in the rectangle: row by row from the top left.
    [[nodiscard]] std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) +
               static_cast<std::size_t>(x - x0);
    }
    [[nodiscard]] bool operator==(const Crop &) const = default;
};

} // namespace hyalite::core
