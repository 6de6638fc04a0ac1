// What a render is begun with, and what it gives away while it runs.
#pragma once

#include "host/film/film.h"
#include "host/film/ray_counts.h"

#include <functional>
#include <optional>
#include <span>

namespace hyalite {

/// Takes copies of a film that is still being rendered. Every pixel of them holds its first samples, as many as its count
/// says, in their order: so any renderer can go on from there, to the same bits.
class SnapshotTaker {
  public:
    virtual ~SnapshotTaker() = default;

    /// Whether a copy is wanted now: asked often, and from any thread.
    [[nodiscard]] virtual bool isWanted() const noexcept = 0;

    /// Called by one thread, soon after a copy was wanted. `copyFilm` fills the pixels that it is given, those of the
    /// whole film; `rays` are those that this render has traced for them. Does not throw.
    virtual void take(const std::function<void(std::span<layout::FilmPixel>)> &copyFilm,
                      const RayCounts &rays) = 0;
};

struct Continuation {
    std::optional<Film> film; ///< of the same crop, to be added to; else the render begins with none
    SnapshotTaker *snapshots = nullptr; ///< where there is one, it outlives the render
};

} // namespace hyalite
