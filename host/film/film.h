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
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
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

/// The mean of the first samples of a pixel.
struct MeanOfFirst {
    glm::vec3 mean{0.0f};
    std::uint32_t sampleCount = 0; ///< 0: they are not known
};

/// The means of a pixel's first samples (first_samples.h).
struct FirstSamples : MeanOfFirst {
    MeanOfFirst half{}; ///< of half as many, while these are nearer to the half of all
    /// Those that the denoiser takes for one half of all.
    [[nodiscard]] const MeanOfFirst &ofDenoiser() const { return half.sampleCount > 0 ? half : *this; }
};
static_assert(sizeof(FirstSamples) == 32); // as files have them

/// What a film has of some pixels.
struct FilmRecords {
    std::vector<layout::FilmPixel> pixels;
    /// Layers of light: of each pixel the sums of the samples of all planes, three channels each, and then the rests of
    /// these sums. Empty without planes.
    std::vector<float> light{};
    /// For the denoiser, of each pixel (first_samples.h). Empty unless they are kept.
    std::vector<FirstSamples> first{};
    /// Of an adaptive render (noise.h), the samples that each pixel is to have; 0 before the first round. Else empty.
    std::vector<std::uint32_t> wanted{};

    /// For each pixel.
    [[nodiscard]] std::size_t lightSize() const { return pixels.empty() ? 0 : light.size() / pixels.size(); }
};

struct Film : FilmRecords {
    Crop crop;                              ///< its pixels are row by row from the top left
    std::vector<std::string> lightPlanes{}; ///< names of the layers of light that are kept

    /// Without samples.
    Film(const Crop &region)
        : FilmRecords{std::vector<layout::FilmPixel>(region.pixelCount())}, crop(region) {}

    /// Keeps layers of light by these names from now on. Their sums stay, if there are as many.
    void keepLight(std::vector<std::string> planes) {
        if (const std::size_t size = pixels.size() * layout::lightWordsPerPlane * planes.size();
            light.size() != size)
            light.assign(size, 0.0f);
        lightPlanes = std::move(planes);
    }

    /// The mean of the samples of each pixel; black without samples.
    [[nodiscard]] Image toImage() const {
        Image image(crop.width(), crop.height());
        std::ranges::transform(pixels, image.pixels().begin(), meanOf);
        return image;
    }
};

/// The mean of the samples of a layer of light in a pixel, both by index; black without samples.
[[nodiscard]] glm::vec3 meanLightOf(const Film &film, std::size_t pixel, std::size_t plane);

/// Row y of the crop, from 0. `film` must outlive it.
[[nodiscard]] std::span<const layout::FilmPixel> rowOf(const Film &film, int y);

/// The layers of light, RGB. `film` must outlive them.
[[nodiscard]] std::vector<Layer> lightLayers(const Film &film);

/// The layers of first samples: their means, RGB, and their numbers; none if they are not kept. `film` must outlive them.
[[nodiscard]] std::vector<Layer> firstSampleLayers(const Film &film);

/// The film as layers: "variance" RGB, that of the mean (varianceOfMean()), unless no pixel has one; "samples", the
/// sample count, as "samples.Y": Blender and Nuke find no layer in a name of one part; and its layers of light.
/// `film` must outlive them.
[[nodiscard]] std::vector<Layer> filmLayers(const Film &film);

/// Whether the pixels of this index are equal in every bit, with all else that the films have of them.
[[nodiscard]] bool haveEqualBits(const FilmRecords &a, const FilmRecords &b, std::size_t pixel);

/// The first pixel that differs in any bit, or the number of pixels.
[[nodiscard]] std::size_t firstDifference(const FilmRecords &a, const FilmRecords &b);

/// Number of pixels that differ in any bit between two films of one crop.
[[nodiscard]] std::size_t differingPixelCount(const Film &a, const Film &b);

} // namespace hyalite::core
