#include "host/film/first_samples.h"

#include "host/film/partition.h"

#include <algorithm>

namespace hyalite::core {

bool isComplete(const FirstSamples &first, std::uint32_t samplesPerPixel) {
    return first.sampleCount == firstSampleCount(samplesPerPixel) &&
           first.half.sampleCount == halfOfFirstCount(samplesPerPixel);
}

bool hasFirst(const Film &film) {
    return !film.first.empty() &&
           std::ranges::equal(film.first, film.pixels,
                              [](const FirstSamples &first, const layout::FilmPixel &pixel) {
                                  return first.sampleCount > 0 && first.sampleCount < pixel.sampleCount;
                              });
}

std::uint32_t samplesBeyondFirst(const Film &film, std::span<const Crop> squares,
                                 std::uint32_t samplesPerPixel) {
    const FilmRecords records = recordsIn(film, squares);
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < records.pixels.size(); ++i) {
        const std::uint32_t count = records.pixels[i].sampleCount;
        const FirstSamples kept = records.first.empty() ? FirstSamples{} : records.first[i];
        const auto isLost = [&](std::uint32_t wanted) {
            return wanted > 0 && count > wanted && kept.sampleCount != wanted &&
                   kept.half.sampleCount != wanted;
        };
        if (isLost(firstSampleCount(samplesPerPixel)) || isLost(halfOfFirstCount(samplesPerPixel)))
            most = std::max(most, count);
    }
    return most;
}

} // namespace hyalite::core
