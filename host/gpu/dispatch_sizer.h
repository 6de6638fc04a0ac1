// How much one dispatch is given to do, so that it takes about as long as is wanted, and never much longer.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hyalite::gpu {

/// Long dispatches block a display, or are ended by the driver; short ones cost more than they do. Two things bound them:
///
/// - the tile and its samples are sized to what samples took lately, so that a dispatch takes about as long as is wanted;
/// - the work of all its slots together is bounded by how fast work was done lately: where the tile is dearer than those
///   before, the dispatch ends soon after that time, and another one does the rest.
///
/// The first dispatches are small, as nothing is known yet.
class DispatchSizer {
  public:
    static constexpr std::uint64_t leastPixels = 256; ///< of a tile that is cut: enough for a few processors

    /// `seconds` > 0 is how long a dispatch should take. Samples are given in whole rounds of `samplesAbreast`, and tiles
    /// have `mostPixels` at most.
    DispatchSizer(double seconds, std::uint32_t samplesAbreast, std::uint64_t mostPixels)
        : seconds_(seconds), samplesAbreast_(samplesAbreast), mostPixels_(mostPixels) {}

    /// The size that a tile should not exceed of whose pixels each wants so many samples. Slots are set up once for all
    /// samples of a dispatch, and so tiles are small rather than gone over again, unless they would be very small.
    [[nodiscard]] std::uint64_t pixels(std::uint32_t samples) const {
        if (sampleSeconds_ == 0.0)
            return std::min(firstPixels, mostPixels_);
        const double sampleCount = seconds_ / sampleSeconds_;
        const double together = std::clamp(samples, samplesAbreast_, std::max(firstSamples, samplesAbreast_));
        const double wanted =
            std::max(sampleCount / together, std::min(sampleCount / samplesAbreast_, double{firstPixels}));
        return static_cast<std::uint64_t>(std::clamp(wanted,
                                                     static_cast<double>(std::min(leastPixels, mostPixels_)),
                                                     static_cast<double>(mostPixels_)));
    }

    /// How many samples to give each pixel of a tile of so many.
    [[nodiscard]] std::uint32_t samples(std::uint64_t pixels) const {
        const double rounds =
            sampleSeconds_ == 0.0
                ? static_cast<double>(firstSamples) / samplesAbreast_
                : seconds_ / (sampleSeconds_ * samplesAbreast_ * static_cast<double>(pixels));
        return static_cast<std::uint32_t>(std::clamp(rounds, 1.0, double{mostRounds})) * samplesAbreast_;
    }

    /// How much work to give a dispatch: layout::DispatchProgress::workDone.
    [[nodiscard]] std::uint32_t work() const {
        if (workSeconds_ == 0.0)
            return firstWork;
        return static_cast<std::uint32_t>(
            std::clamp(mostTimes * seconds_ / workSeconds_, 1.0, double{mostWork}));
    }

    /// A dispatch did so much work. Short ones count for little: they must not make forgotten how dear work can be.
    void learnWork(double seconds, std::uint64_t work) {
        if (work > 0)
            learn(workSeconds_, seconds / static_cast<double>(work), std::min(seconds / seconds_, 1.0));
    }

    /// One or more dispatches gave so many samples to all their pixels together.
    void learnSamples(double seconds, std::uint64_t samples) {
        if (samples > 0)
            learn(sampleSeconds_, seconds / static_cast<double>(samples), 1.0);
    }

  private:
    static constexpr std::uint64_t firstPixels = 1024;
    static constexpr std::uint32_t firstSamples = 32;
    static constexpr std::uint32_t firstWork = 1u << 20;
    static constexpr std::uint32_t mostWork = 1u << 30; ///< what is in flight comes on top, in 32 bits
    static constexpr std::uint32_t mostRounds = 1u << 13;
    static constexpr double mostTimes = 1.25; ///< as long as is wanted

    /// Dearer at once, as the next dispatch must not be long; cheaper bit by bit, faster with more `weight`. No single
    /// one counts for more than four times what is known: the machine may have been busy with something else.
    static void learn(double &known, double found, double weight) {
        if (found <= 0.0)
            return;
        if (known == 0.0)
            known = found;
        else
            known = found > known ? std::min(found, 4.0 * known) : known + 0.25 * weight * (found - known);
    }

    double seconds_;
    std::uint32_t samplesAbreast_;
    std::uint64_t mostPixels_;
    double sampleSeconds_ = 0.0; ///< beside the others; 0: not known
    double workSeconds_ = 0.0;   ///< beside the others; 0: not known
};

} // namespace hyalite::gpu
