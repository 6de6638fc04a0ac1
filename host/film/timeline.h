// Timeline of a render: plain data for traces, tables and reports.
#pragma once

#include "host/film/ray_counts.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// The current time in nanoseconds of the host's monotonic clock, since an arbitrary epoch.
[[nodiscard]] inline std::int64_t hostNanos() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// A time span, in nanoseconds of hostNanos().
struct Span {
    std::int64_t beginNanos = 0;
    std::int64_t endNanos = 0; ///< never before the beginning

    [[nodiscard]] double seconds() const { return static_cast<double>(endNanos - beginNanos) * 1e-9; }
    [[nodiscard]] double millis() const { return static_cast<double>(endNanos - beginNanos) * 1e-6; }
    bool operator==(const Span &) const = default;
};

/// Measures consecutive spans: every lap begins where the last one ended.
class Stopwatch {
  public:
    Span lap() {
        const std::int64_t begin = lapBegin_;
        lapBegin_ = hostNanos();
        return {begin, lapBegin_};
    }

  private:
    std::int64_t lapBegin_ = hostNanos();
};

/// Times of one run of a kernel.
struct RunTimes {
    Span host; ///< from before its submission until the host knew that it was finished
    /// The span by the device's clock, placed inside `host` on the host's time line. Empty if the device has no
    /// timestamps.
    std::optional<Span> device;

    /// The best estimate of the kernel's own time.
    [[nodiscard]] const Span &best() const { return device ? *device : host; }
};

/// One run of a kernel on one tile, or one call of the reference renderer.
struct DispatchRecord {
    std::string kernel;
    int tileX = 0; ///< pixel of the whole image where the tile begins
    int tileY = 0;
    int tileWidth = 0; ///< pixels, without what reaches beyond the film
    int tileHeight = 0;
    std::uint32_t sampleBegin = 0; ///< the samples [sampleBegin, sampleEnd) of each pixel were asked for
    std::uint32_t sampleEnd = 0;
    bool isResumed = false; ///< continues the tile's last dispatch, whose steps were spent
    RayCounts rays;         ///< of the samples that it finished
    std::uint64_t invocations = 0;
    RunTimes times;
};

/// One part of a render: "upload", "pipeline" and so on.
struct StageRecord {
    std::string name;
    Span span;
    std::uint64_t deviceBytes = 0; ///< buffers on the device when the stage ended
};

/// All of a render, in the order in which it happened. Bands of a large film repeat stages.
struct Timeline {
    std::vector<StageRecord> stages;
    std::vector<DispatchRecord> dispatches;
    std::string clock; ///< description of the clock that timed the dispatches
};

} // namespace hyalite::core
