#include "host/film/first_samples.h"

#include "host/film/partition.h"

#include <algorithm>

namespace hyalite::core {

bool hasFirst(const Film &film) {
    return !film.first.empty() &&
           std::ranges::equal(film.first, film.pixels,
                              [](const FirstSamples &first, const layout::FilmPixel &pixel) {
                                  return first.sampleCount > 0 && first.sampleCount < pixel.sampleCount;
                              });
}

std::uint32_t samplesBeyondFirst(const Film &film, std::span<const Crop> squares,
                                 std::uint32_t samplesPerPixel) {
    const std::uint32_t firstCount = firstSampleCount(samplesPerPixel);
    const FilmRecords records = recordsIn(film, squares);
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < records.pixels.size(); ++i) {
        const std::uint32_t count = records.pixels[i].sampleCount;
        const bool isKept = !records.first.empty() && records.first[i].sampleCount == firstCount;
        if (count > firstCount && !isKept)
            most = std::max(most, count);
    }
    return most;
}

} // namespace hyalite::core
