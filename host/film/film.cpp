#include "host/film/film.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace hyalite::core {

std::span<const layout::FilmPixel> rowOf(const Film &film, int y) {
    const auto width = static_cast<std::size_t>(film.crop.width());
    return std::span(film.pixels).subspan(static_cast<std::size_t>(y) * width, width);
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
    return layers;
}

bool haveEqualBits(const layout::FilmPixel &a, const layout::FilmPixel &b) {
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    return std::memcmp(&a, &b, sizeof a) == 0;
}

std::size_t differingPixelCount(const Film &a, const Film &b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += haveEqualBits(a.pixels[i], b.pixels[i]) ? 0u : 1u;
    return count;
}

} // namespace hyalite::core
