// The rounds of a render, in each of which its pixels get the samples that they are to have.
#pragma once

#include "host/film/film.h"
#include "host/film/noise.h"
#include "host/scene/settings.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace hyalite::core {

/// One round, or those of the film's blocks until their noise is low enough (noise.h).
class SampleRounds {
  public:
    /// Makes the film one that keeps wanted counts, or one that does not. Pixels of others have all samples already,
    /// without a wanted count. `settings` must outlive it.
    SampleRounds(Film &film, const RenderSettings &settings);

    /// Sets what pixels are to have next; returns false if all have what they need. `onNoise`, unless empty, gets the
    /// highest noise of a block.
    [[nodiscard]] bool begin(Film &film, const std::function<void(double)> &onNoise);

    /// Those that are there: of an adaptive render, without those of others.
    [[nodiscard]] std::uint64_t samplesIn(const Film &film) const;

    /// The finished share of the whole, with so many samples; never less than before. That of an adaptive render is a
    /// guess.
    [[nodiscard]] double share(double samples);

  private:
    const RenderSettings &settings_;
    std::vector<NoiseBlock> blocks_; ///< of an adaptive render, without those of others
    double shareOfOthers_ = 0.0;
    double expectedSamples_;
    double share_ = 0.0;
};

} // namespace hyalite::core
