// The film: what both renderers fill, one record a pixel of the crop.
#pragma once

#include "host/image/image.h"
#include "shaders/layout.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <limits>
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

/// The unbiased estimate of the variance of the mean of a pixel's samples, per channel:
///
///     (sum x^2 - (sum x)^2 / n) / (n - 1) / n
///
/// with Bessel's correction. It takes samples for independent; low-discrepancy ones have less. NaN below two samples.
/// The film's sums are float32: as little as 2^-24 of the square of the mean is beneath their rounding.
[[nodiscard]] inline glm::dvec3 varianceOfMean(const layout::FilmPixel &pixel) {
    if (pixel.sampleCount < 2)
        return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    const double count = pixel.sampleCount;
    const glm::dvec3 sum(pixel.sum);
    const glm::dvec3 deviation = glm::dvec3(pixel.sumOfSquares) - sum * sum / count;
    return glm::max(deviation, glm::dvec3(0.0)) / ((count - 1.0) * count);
}

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
