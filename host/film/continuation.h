// Continuation of renders: the film that a render starts with, and copies of it that it gives away while it runs.
#pragma once

#include "host/film/film.h"
#include "host/film/ray_counts.h"

#include <functional>
#include <optional>
#include <span>

namespace hyalite {

/// Takes copies of a film during its render. Every pixel of a copy has its first `sampleCount` samples in their order,
/// so any renderer can continue from it to the same bits.
class SnapshotTaker {
  public:
    virtual ~SnapshotTaker() = default;

    /// Whether a copy is wanted now. Called often, and from any thread.
    [[nodiscard]] virtual bool isWanted() const noexcept = 0;

    /// Called by one thread, soon after a copy was wanted. `copyFilm` fills the pixels of the whole film; `rays` were
    /// traced by this render for them. Does not throw.
    virtual void take(const std::function<void(std::span<layout::FilmPixel>)> &copyFilm,
                      const RayCounts &rays) = 0;
};

struct Continuation {
    /// Samples are added to it. It decides which crop is rendered. Empty: start with none, of the scene's crop.
    std::optional<Film> film;
    SnapshotTaker *snapshots = nullptr; ///< if not null, it outlives the render
    /// Of the film's pixels, in [0, 1): they have all samples already, as others render them.
    double shareOfOthers = 0.0;
};

} // namespace hyalite
