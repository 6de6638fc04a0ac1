// Sizes of dispatches, so that each takes about as long as wanted and never much longer.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hyalite::core::gpu {

/// Costs of samples and of work, by the dispatches so far; 0: unknown.
struct DispatchCosts {
    double sampleSeconds = 0.0; ///< per sample, with all slots running
    double workSeconds = 0.0;   ///< per unit of work, likewise
};

/// Long dispatches block a display or are ended by the driver; short ones waste time on overhead. Two bounds keep them
/// in between:
///
/// - the number of pixels and samples, by the time that recent samples took;
/// - the work of all slots together, by the time that recent work took. If a tile is more expensive than those before,
/// the dispatch ends soon after the wanted time, and another one continues.
///
/// The first dispatches are small, unless costs are known from the same scene.
class DispatchSizer {
  public:
    static constexpr std::uint64_t minPixels = 256; ///< of a tile: enough for a few processors

    /// `seconds` > 0 is the wanted time of a dispatch. Sample counts are whole rounds of `samplesInFlight`; tiles have
    /// at most `maxPixels` pixels.
    DispatchSizer(double seconds, std::uint32_t samplesInFlight, std::uint64_t maxPixels,
                  const DispatchCosts &known = {})
        : seconds_(seconds), samplesInFlight_(samplesInFlight), maxPixels_(maxPixels),
          sampleSeconds_(known.sampleSeconds), workSeconds_(known.workSeconds) {}

    [[nodiscard]] DispatchCosts costs() const { return {sampleSeconds_, workSeconds_}; }

    /// Maximum number of pixels of a tile that needs `samples` samples per pixel. Slots are set up once per dispatch,
    /// so a small tile with all its samples is better than a large one in several dispatches, unless it would be very
    /// small.
    [[nodiscard]] std::uint64_t pixels(std::uint32_t samples) const {
        if (sampleSeconds_ == 0.0)
            return std::min(firstPixels, maxPixels_);
        const double sampleCount = seconds_ / sampleSeconds_;
        const double together =
            std::clamp(samples, samplesInFlight_, std::max(firstSamples, samplesInFlight_));
        const double wanted =
            std::max(sampleCount / together, std::min(sampleCount / samplesInFlight_, double{firstPixels}));
        return static_cast<std::uint64_t>(std::clamp(
            wanted, static_cast<double>(std::min(minPixels, maxPixels_)), static_cast<double>(maxPixels_)));
    }

    /// Samples per pixel for a tile of `pixels` pixels.
    [[nodiscard]] std::uint32_t samples(std::uint64_t pixels) const {
        const double rounds =
            sampleSeconds_ == 0.0
                ? static_cast<double>(firstSamples) / samplesInFlight_
                : seconds_ / (sampleSeconds_ * samplesInFlight_ * static_cast<double>(pixels));
        return static_cast<std::uint32_t>(std::clamp(rounds, 1.0, double{maxRounds})) * samplesInFlight_;
    }

    /// Work budget of a dispatch, in units of layout::DispatchProgress::workDone.
    [[nodiscard]] std::uint32_t work() const {
        if (workSeconds_ == 0.0)
            return firstWork;
        return static_cast<std::uint32_t>(
            std::clamp(maxOvershoot * seconds_ / workSeconds_, 1.0, double{maxWork}));
    }

    /// Learns from a dispatch. A short one gets little weight, so that it cannot hide expensive work.
    void learnWork(double seconds, std::uint64_t work) {
        if (work > 0)
            learn(workSeconds_, seconds / static_cast<double>(work), std::min(seconds / seconds_, 1.0));
    }

    /// Learns from dispatches that took `samples` samples in all.
    void learnSamples(double seconds, std::uint64_t samples) {
        if (samples > 0)
            learn(sampleSeconds_, seconds / static_cast<double>(samples), 1.0);
    }

  private:
    static constexpr std::uint64_t firstPixels = 1024;
    static constexpr std::uint32_t firstSamples = 32;
    static constexpr std::uint32_t firstWork = 1u << 20;
    static constexpr std::uint32_t maxWork = 1u << 30; ///< leaves room in 32 bits for the work in flight
    static constexpr std::uint32_t maxRounds = 1u << 13;
    static constexpr double maxOvershoot = 1.25; ///< of the wanted time

    /// A higher cost is learned at once, because the next dispatch must not be long; a lower one gradually, faster with
    /// more `weight`. No dispatch raises the cost more than fourfold: the machine may have been busy with something
    /// else.
    static void learn(double &known, double measured, double weight) {
        if (measured <= 0.0)
            return;
        if (known == 0.0)
            known = measured;
        else
            known = measured > known ? std::min(measured, 4.0 * known)
                                     : known + 0.25 * weight * (measured - known);
    }

    double seconds_;
    std::uint32_t samplesInFlight_;
    std::uint64_t maxPixels_;
    double sampleSeconds_; ///< as in DispatchCosts
    double workSeconds_;
};

} // namespace hyalite::core::gpu
