// The film: a record for each pixel of the crop, which both renderers fill.
#pragma once

#include "host/image/crop.h"
#include "host/image/image.h"
#include "host/image/picture.h"
#include "shaders/layout/layout.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace hyalite {

/// The unbiased estimate of the variance of the mean of a pixel's samples, per channel:
///
///     (sum x^2 - (sum x)^2 / n) / (n - 1) / n
///
/// with Bessel's correction. It assumes independent samples; low-discrepancy samples have less variance. NaN below two
/// samples. The sums of the film are float32: variances below 2^-24 of the squared mean are lost in rounding.
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

    /// The mean of the samples of each pixel; black without samples.
    [[nodiscard]] Image toImage() const {
        Image image(crop.width(), crop.height());
        for (std::size_t i = 0; i < pixels.size(); ++i)
            if (pixels[i].sampleCount > 0)
                image.pixels()[i] = pixels[i].sum / static_cast<float>(pixels[i].sampleCount);
        return image;
    }
};

/// Row y of the crop, from 0. `film` must outlive it.
[[nodiscard]] std::span<const layout::FilmPixel> rowOf(const Film &film, int y);

/// The film as layers: "variance" RGB, that of the mean (varianceOfMean()), unless no pixel has one; and "samples", the
/// sample count. `film` must outlive them.
[[nodiscard]] std::vector<Layer> filmLayers(const Film &film);

/// Whether two pixels are equal in every bit.
[[nodiscard]] bool haveEqualBits(const layout::FilmPixel &a, const layout::FilmPixel &b);

/// Number of pixels that differ in any bit between two films of one crop.
[[nodiscard]] std::size_t differingPixelCount(const Film &a, const Film &b);

} // namespace hyalite
