// The queue of tiles of a picture that several renderers share.
#pragma once

#include "host/film/film.h"
#include "host/image/crop.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace hyalite::core {

/// The unfinished pixels of a film as rectangles, which are cut as they are given out. For one thread at a time.
class TileQueue {
  public:
    static constexpr int blockSide = 8; // a tile's sides are multiples of it, except for the last of the film

    /// All of the film that has fewer than `samplesPerPixel` samples. Where much is finished, tiles may have finished
    /// pixels, too.
    TileQueue(const Film &film, std::uint32_t samplesPerPixel);

    /// The next tile, of at most `maxPixels` unless it is a block of 8x8. Empty: none is left.
    [[nodiscard]] std::optional<Crop> take(std::uint64_t maxPixels);

    /// A tile that was not finished: it is the next to be given out.
    void giveBack(const Crop &tile);

    /// Pixels that wait.
    [[nodiscard]] std::uint64_t pixelCount() const { return pixelCount_; }

  private:
    std::vector<Crop> waiting_; ///< the next one last
    std::uint64_t pixelCount_ = 0;
};

/// A renderer's speed and its limits, which decide how large its next tile is.
struct TileWish {
    double samplesPerPixel = 1.0;
    double samplesPerSecond = 0.0;    ///< of the renderer; 0: unknown
    double allSamplesPerSecond = 0.0; ///< of all renderers together
    double lastSamples = 0.0;         ///< in its last tile
    double waitingPixels = 0.0;
};

/// The pixels of a renderer's next tile: a sixteenth of what would be its share of all that waits, so that a tile which
/// costs more than was guessed does not end after all others (tests/bench/farm_model.cpp: with half of the share 256
/// renderers take 1.7 times as long); all of it if it is the only one. But what it renders in 0.05 s at least and in 2
/// s at most, eight times the last tile at most, and a workgroup's 64 at least. Tiles that took longer would lose more
/// when the program is killed between two checkpoints, and shorter ones cost more than they gain.
[[nodiscard]] std::uint64_t tilePixels(const TileWish &wish);

} // namespace hyalite::core
