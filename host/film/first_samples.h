// First samples: the mean of the first samples of each pixel, beside that of all. Where the two differ, a picture is noisy
// or has a detail; the denoiser tells which.
#pragma once

#include "host/film/film.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core {

/// The number of a pixel's first samples: the largest power of two below that of all samples, as any power of two of the
/// sampler's points is spread evenly. 0 if there is one sample only.
[[nodiscard]] constexpr std::uint32_t firstSampleCount(std::uint32_t samplesPerPixel) {
    return std::bit_floor(samplesPerPixel - 1);
}

/// Half of them, if a pixel of so many samples keeps these, too: of 17 samples 8 are a better half than 16, which those that
/// are added later will need. Else 0.
[[nodiscard]] constexpr std::uint32_t halfOfFirstCount(std::uint32_t samplesPerPixel) {
    const std::uint32_t firstCount = firstSampleCount(samplesPerPixel);
    return 2 * std::uint64_t{samplesPerPixel} < 3 * std::uint64_t{firstCount} ? firstCount / 2 : 0;
}

/// Whether a pixel of so many samples has all means of its first ones.
[[nodiscard]] bool isComplete(const FirstSamples &first, std::uint32_t samplesPerPixel);

/// Whether all pixels have first samples, and others beside them.
[[nodiscard]] bool hasFirst(const Film &film);

/// The largest sample count of a pixel in the squares that has too many samples for taking the first ones of a render
/// with `samplesPerPixel`, and not those already; 0 if there is none.
[[nodiscard]] std::uint32_t samplesBeyondFirst(const Film &film, std::span<const Crop> squares,
                                               std::uint32_t samplesPerPixel);

} // namespace hyalite::core
