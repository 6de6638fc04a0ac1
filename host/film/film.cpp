#include "host/film/film.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

namespace hyalite::core {

std::span<const layout::FilmPixel> rowOf(const Film &film, int y) {
    const auto width = static_cast<std::size_t>(film.crop.width());
    return std::span(film.pixels).subspan(static_cast<std::size_t>(y) * width, width);
}

glm::vec3 meanLightOf(const Film &film, std::size_t pixel, std::size_t plane) {
    const std::uint32_t count = film.pixels[pixel].sampleCount;
    if (count == 0)
        return glm::vec3(0.0f);
    const float *sums = &film.light[pixel * film.lightSize() + 3 * plane];
    const float *rests = sums + 3 * film.lightPlanes.size();
    const glm::dvec3 sum = glm::dvec3(sums[0], sums[1], sums[2]) + glm::dvec3(rests[0], rests[1], rests[2]);
    return glm::vec3(sum / static_cast<double>(count));
}

std::vector<Layer> lightLayers(const Film &film) {
    std::vector<Layer> layers;
    for (std::size_t plane = 0; plane < film.lightPlanes.size(); ++plane) {
        const auto fillRow = [&film, plane](int y, std::span<float> row) {
            const auto width = static_cast<std::size_t>(film.crop.width());
            for (std::size_t x = 0; x < width; ++x) {
                const glm::vec3 mean = meanLightOf(film, static_cast<std::size_t>(y) * width + x, plane);
                for (int channel = 0; channel < 3; ++channel)
                    row[3 * x + static_cast<std::size_t>(channel)] = mean[channel];
            }
        };
        layers.push_back({film.lightPlanes[plane], "RGB", fillRow});
        layers.back().isLight = true;
    }
    return layers;
}

std::vector<Layer> firstSampleLayers(const Film &film) {
    if (film.first.empty())
        return {};
    const auto rowOfFirst = [&film](int y) {
        const auto width = static_cast<std::size_t>(film.crop.width());
        return std::span(film.first).subspan(static_cast<std::size_t>(y) * width, width);
    };
    Layer means{"denoising_first", "RGB", [rowOfFirst](int y, std::span<float> row) {
                    float *next = row.data();
                    for (const FirstSamples &first : rowOfFirst(y))
                        for (int channel = 0; channel < 3; ++channel)
                            *next++ = first.ofDenoiser().mean[channel];
                }};
    Layer counts{"denoising_first_samples", "Y", [rowOfFirst](int y, std::span<float> row) {
                     std::ranges::transform(rowOfFirst(y), row.begin(), [](const FirstSamples &first) {
                         return static_cast<float>(first.ofDenoiser().sampleCount);
                     });
                 }};
    counts.fillWholeRow = [rowOfFirst](int y, std::span<std::uint32_t> row) {
        std::ranges::transform(rowOfFirst(y), row.begin(),
                               [](const FirstSamples &first) { return first.ofDenoiser().sampleCount; });
    };
    return {std::move(means), std::move(counts)};
}

std::vector<Layer> filmLayers(const Film &film) {
    std::vector<Layer> layers;
    const auto hasVariance = [](const layout::FilmPixel &pixel) { return pixel.sampleCount > 1; };
    if (std::any_of(film.pixels.begin(), film.pixels.end(), hasVariance))
        layers.push_back({"variance", "RGB", [&film](int y, std::span<float> row) {
                              float *next = row.data();
                              for (const layout::FilmPixel &pixel : rowOf(film, y)) {
                                  const glm::dvec3 variance = varianceOfMean(pixel);
                                  for (int channel = 0; channel < 3; ++channel)
                                      *next++ = static_cast<float>(variance[channel]);
                              }
                          }});
    Layer samples{"samples", "Y", {}};
    samples.fillWholeRow = [&film](int y, std::span<std::uint32_t> row) {
        std::ranges::transform(rowOf(film, y), row.begin(), &layout::FilmPixel::sampleCount);
    };
    layers.push_back(std::move(samples));
    std::ranges::move(lightLayers(film), std::back_inserter(layers));
    return layers;
}

bool haveEqualBits(const FilmRecords &a, const FilmRecords &b, std::size_t pixel) {
    const std::size_t size = a.lightSize();
    if (size != b.lightSize() || a.first.empty() != b.first.empty() || a.wanted.empty() != b.wanted.empty())
        return false;
    // NOLINTBEGIN(bugprone-suspicious-memory-comparison)
    return std::memcmp(&a.pixels[pixel], &b.pixels[pixel], sizeof a.pixels[pixel]) == 0 &&
           (size == 0 ||
            std::memcmp(&a.light[pixel * size], &b.light[pixel * size], size * sizeof(float)) == 0) &&
           (a.first.empty() || std::memcmp(&a.first[pixel], &b.first[pixel], sizeof a.first[pixel]) == 0) &&
           (a.wanted.empty() || a.wanted[pixel] == b.wanted[pixel]);
    // NOLINTEND(bugprone-suspicious-memory-comparison)
}

std::size_t firstDifference(const FilmRecords &a, const FilmRecords &b) {
    std::size_t pixel = 0;
    while (pixel < a.pixels.size() && haveEqualBits(a, b, pixel))
        ++pixel;
    return pixel;
}

std::size_t differingPixelCount(const Film &a, const Film &b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += haveEqualBits(a, b, i) ? 0u : 1u;
    return count;
}

} // namespace hyalite::core
