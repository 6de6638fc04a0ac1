// Hooks of renders: what a render tells and asks while it runs, and copies of its film that it gives away.
#pragma once

#include "host/film/film.h"
#include "host/film/ray_counts.h"
#include "host/film/timeline.h"

#include <functional>

namespace hyalite::core {

/// Takes copies of a film during its render. Every pixel of a copy has its first `sampleCount` samples in their order,
/// so any renderer can continue from it to the same bits.
class SnapshotTaker {
  public:
    virtual ~SnapshotTaker() = default;

    /// Whether a copy is wanted now. Called often, and from any thread.
    [[nodiscard]] virtual bool isWanted() const noexcept = 0;

    /// Called by one thread, soon after a copy was wanted. `copyTo` copies the whole film; `rays` were traced by this
    /// render for it. Does not throw.
    virtual void take(const std::function<void(Film &)> &copyTo, const RayCounts &rays) = 0;
};

/// All may be empty.
struct RenderHooks {
    /// Called occasionally, never by two threads at once, with the finished fraction of the film's samples, in [0, 1].
    std::function<void(double)> onProgress{};
    /// Called often, possibly by several threads at once. Once it returns true, the film has the samples that are
    /// finished.
    std::function<bool()> shouldStop{};
    /// Of an adaptive render, between its rounds: the highest noise of a block (noise.h). By the caller's own thread.
    std::function<void(double)> onNoise{};
    Timeline *timeline = nullptr;       ///< records what happened when
    SnapshotTaker *snapshots = nullptr; ///< takes copies of the film
};

} // namespace hyalite::core
