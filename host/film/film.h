// The film: a record for each pixel of the crop, which both renderers fill.
#pragma once

#include "host/image/crop.h"
#include "host/image/image.h"
#include "host/image/picture.h"
#include "shaders/layout/layout.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace hyalite::core {

/// The sum of the samples' radiance, with the rest that float32 leaves out.
[[nodiscard]] inline glm::dvec3 sumOf(const layout::FilmPixel &pixel) {
    return glm::dvec3(pixel.sum) + glm::dvec3(pixel.sumRest);
}

/// The mean of the samples, rounded to float32 once; black without samples.
[[nodiscard]] inline glm::vec3 meanOf(const layout::FilmPixel &pixel) {
    return pixel.sampleCount > 0 ? glm::vec3(sumOf(pixel) / static_cast<double>(pixel.sampleCount))
                                 : glm::vec3(0.0f);
}

/// The share of the pixel that is not transparent, from 0 to 1; 0 without samples. Through glass, a few samples may be
/// out of that range: their mean is not.
[[nodiscard]] inline float alphaOf(const layout::FilmPixel &pixel) {
    if (pixel.sampleCount == 0)
        return 0.0f;
    const double sum = static_cast<double>(pixel.transparency) + static_cast<double>(pixel.transparencyRest);
    return static_cast<float>(std::clamp(1.0 - sum / pixel.sampleCount, 0.0, 1.0));
}

/// The unbiased estimate of the variance of the mean of a pixel's samples, per channel:
///
///     (sum x^2 - (sum x)^2 / n) / (n - 1) / n
///
/// with Bessel's correction. It assumes independent samples; low-discrepancy samples have less variance. NaN below two
/// samples. Squares are rounded to float32 before they are summed: variances of samples below 2^-24 of the squared mean
/// are lost in rounding.
[[nodiscard]] inline glm::dvec3 varianceOfMean(const layout::FilmPixel &pixel) {
    if (pixel.sampleCount < 2)
        return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    const double count = pixel.sampleCount;
    const glm::dvec3 sum = sumOf(pixel);
    const glm::dvec3 squares = glm::dvec3(pixel.sumOfSquares) + glm::dvec3(pixel.squaresRest);
    const glm::dvec3 deviation = squares - sum * sum / count;
    return glm::max(deviation, glm::dvec3(0.0)) / ((count - 1.0) * count);
}

struct Film {
    Crop crop;
    std::vector<layout::FilmPixel> pixels; ///< row by row from the top left

    /// Without samples.
    Film(const Crop &region)
        : crop(region),
          pixels(static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height())) {}

    /// The mean of the samples of each pixel; black without samples.
    [[nodiscard]] Image toImage() const {
        Image image(crop.width(), crop.height());
        std::ranges::transform(pixels, image.pixels().begin(), meanOf);
        return image;
    }
};

/// Row y of the crop, from 0. `film` must outlive it.
[[nodiscard]] std::span<const layout::FilmPixel> rowOf(const Film &film, int y);

/// The film as layers: "variance" RGB, that of the mean (varianceOfMean()), unless no pixel has one; and "samples", the
/// sample count, as "samples.Y": Blender and Nuke find no layer in a name of one part. `film` must outlive them.
[[nodiscard]] std::vector<Layer> filmLayers(const Film &film);

/// Whether two pixels are equal in every bit.
[[nodiscard]] bool haveEqualBits(const layout::FilmPixel &a, const layout::FilmPixel &b);

/// Number of pixels that differ in any bit between two films of one crop.
[[nodiscard]] std::size_t differingPixelCount(const Film &a, const Film &b);

} // namespace hyalite::core
