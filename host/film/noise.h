// Noise: the estimated error of a picture, and how many samples its pixels need. All is decided block by block, from the
// block's own pixels, in double precision by + - * / and square roots alone: so it is the same for any tile, part, device
// and machine.
//
// The noise of a block is the square root of the mean, over its pixels and channels, of
//
//     variance of the mean / (m^2 + darkness^2)
//
// m is the pixel's mean, or that of its neighbours where theirs is less: one bright path in a dark place is no light place.
// But where a pixel's samples agree, as those of a lamp in the dark do, m is its mean less the standard deviation of that.
//
// Samples are points of a scrambled net, so that the variance of their mean falls faster than theirs by their number: as
// n^-p. A block's p is found by what is known beside the variance of single samples: the first samples of a pixel and all of
// them differ by the variance that the others took away (Var of m samples - Var of n). Between powers of two, n * Var is
// taken as linear in n.
#pragma once

#include "host/film/film.h"
#include "host/film/partition.h"
#include "host/scene/settings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core {

inline constexpr int noiseBlockSide = 32;

/// The radiance that counts as dark where the exposure is seen: pixels much darker may have as much error as those of it.
[[nodiscard]] double darknessOf(const RenderSettings &settings);

/// What a render is to reach.
struct NoiseTarget {
    double noise;    ///< of each block
    double darkness; ///< as darknessOf()
    std::uint32_t maxSamples;
};

/// The settings' own. Requires isAdaptive(settings).
[[nodiscard]] NoiseTarget noiseTargetOf(const RenderSettings &settings);

/// The exposure by which darkness is seen, in whole stops.
[[nodiscard]] int stopsOfDarkness(const RenderSettings &settings);

/// The smallest side of a square of parts (partition.h) of a render with this target; 0: without one.
[[nodiscard]] constexpr int smallestSquare(double noise) {
    return noise > 0.0 ? noiseBlockSide : Partition::minSide;
}

/// A block's pixels among those of a film: `height` rows of `width`, from `first` on, `stride` apart. At the right and
/// lower edges of a picture it is cut.
struct NoiseBlock {
    std::size_t first;
    std::size_t stride;
    std::size_t width;
    std::size_t height;

    [[nodiscard]] std::size_t pixelCount() const { return width * height; }
    /// Of the block's pixel i, row by row.
    [[nodiscard]] std::size_t indexOf(std::size_t i) const { return first + i / width * stride + i % width; }
};

/// The blocks of these squares of a film, each of whole blocks (partition.h).
[[nodiscard]] std::vector<NoiseBlock> blocksInFilm(const Crop &film, std::span<const Crop> squares);

/// The blocks of records that have these squares, one after another.
[[nodiscard]] std::vector<NoiseBlock> blocksInRecords(std::span<const Crop> squares);

/// The samples that a pixel is to have in the present round of its block.
[[nodiscard]] inline std::uint32_t targetOf(const FilmRecords &film, std::size_t pixel,
                                            std::uint32_t maxSamples) {
    return film.wanted.empty() ? maxSamples : std::min(film.wanted[pixel], maxSamples);
}

/// Whether a block has all samples that it is to have: its noise is low enough, or a pixel has as many as are allowed.
enum class BlockState { Unfinished, AtTarget, AtLimit };

struct BlockNoise {
    double
        noise; ///< infinite if a pixel has no first samples; pixels that are not finite count as without noise
    BlockState state;
};
[[nodiscard]] BlockNoise noiseOf(const FilmRecords &film, const NoiseBlock &block, const NoiseTarget &target);

/// Of each pixel, its relative variance as of independent samples, which first samples need not be known for; 0 below two
/// samples.
[[nodiscard]] std::vector<double> squaredNoiseOfPixels(const FilmRecords &film, const NoiseBlock &block,
                                                       double darkness);

/// Begins the next round of each unfinished block, which has finished the one before: a quarter more samples, in
/// proportion to the noise of single samples around each pixel. A pixel's own samples are left out, as they would make
/// its mean darker: bright ones would ask for others. A round depends neither on the target nor on the limit. The first
/// one has 16 samples each. Returns the noise before it.
std::vector<BlockNoise> beginRounds(FilmRecords &film, std::span<const NoiseBlock> blocks,
                                    const NoiseTarget &target);

/// The noise of all blocks together.
struct PictureNoise {
    double highest = 0.0; ///< of a block
    double mean = 0.0;    ///< root of the mean square over all pixels
    std::size_t blockCount = 0;
    std::size_t atTarget = 0;         ///< blocks
    std::size_t atLimit = 0;          ///< likewise, above the target
    std::uint64_t finishedPixels = 0; ///< in blocks of either kind
};
[[nodiscard]] PictureNoise noiseOf(const FilmRecords &film, std::span<const NoiseBlock> blocks,
                                   const NoiseTarget &target);

} // namespace hyalite::core
