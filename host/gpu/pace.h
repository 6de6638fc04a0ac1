// How much one dispatch is given to do, so that it takes about as long as is wanted.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hyalite::gpu {

/// Long dispatches block a display, or are ended by the driver; short ones cost more than they do. Learns from how long
/// the last one took: fewer samples a pixel first, then fewer steps, down to what still makes progress.
class Pace {
  public:
    /// `seconds` > 0 is how long a dispatch may take. Samples are given in whole rounds of `samplesAbreast`.
    Pace(double seconds, std::uint32_t samplesAbreast, std::uint32_t mostSteps)
        : seconds_(seconds), leastSamples_(samplesAbreast), mostSteps_(mostSteps),
          samples_(std::max(samplesAbreast, firstSamples)), steps_(mostSteps) {}

    [[nodiscard]] std::uint32_t samples() const { return samples_; }
    [[nodiscard]] std::uint32_t steps() const { return steps_; }

    /// Takes in how long a dispatch took that was given `samples()` and `steps()`.
    void learn(double seconds) {
        if (seconds > seconds_ && samples_ > leastSamples_)
            samples_ = std::max(samples_ / 2, leastSamples_);
        else if (seconds > seconds_)
            steps_ = std::max(steps_ / 2, std::min(leastSteps, mostSteps_));
        else if (seconds < seconds_ / 3.0 && steps_ < mostSteps_)
            steps_ = std::min(steps_ * 2, mostSteps_);
        else if (seconds < seconds_ / 3.0)
            samples_ = std::min(samples_ * 2, mostSamples);
    }

  private:
    static constexpr std::uint32_t firstSamples = 32;
    static constexpr std::uint32_t mostSamples = 1u << 16;
    static constexpr std::uint32_t leastSteps = 256;

    double seconds_;
    std::uint32_t leastSamples_;
    std::uint32_t mostSteps_;
    std::uint32_t samples_;
    std::uint32_t steps_;
};

} // namespace hyalite::gpu
