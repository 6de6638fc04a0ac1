// Renderers in other processes: rank 0 gives tiles to the other ranks, which have loaded the same scene.
#pragma once

#include "host/engine/backend.h"
#include "host/farm/ranks.h"

#include <memory>
#include <string>
#include <vector>

namespace hyalite::core {

/// For rank 0: lets the other ranks go when it is destroyed, however rank 0 ends.
class RankPool {
  public:
    /// `ranks` must outlive it.
    explicit RankPool(Ranks &ranks) : ranks_(ranks) {}
    ~RankPool();
    RankPool(const RankPool &) = delete;
    RankPool &operator=(const RankPool &) = delete;

    /// Waits until each rank has said what it has, and makes a backend of it. One that could not load the scene or open
    /// a renderer, or that adds other samples to a film than `backend` does, is left out, with a note. They render the
    /// scene that the ranks have loaded, whichever they are given. The backends must not outlive this.
    [[nodiscard]] std::vector<std::unique_ptr<Backend>>
    backends(const PreparedScene &scene, const Backend &backend, std::vector<std::string> &notes);

  private:
    Ranks &ranks_;
};

/// For the other ranks: renders tiles for rank 0, until it lets them go.
void serveTiles(Ranks &ranks, const PreparedScene &scene, Backend &backend);

/// In place of serveTiles(): tells rank 0 why there is no renderer here, and waits to be let go.
void reportFailure(Ranks &ranks, const std::string &why);

} // namespace hyalite::core
