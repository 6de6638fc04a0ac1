// Repeated renders: one film again and again, each compared with the film that it should be.
#pragma once

#include "host/film/film.h"
#include "host/film/ray_counts.h"
#include "host/film/timeline.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <optional>

namespace hyalite::core {

/// The film without samples, rendered anew, and compared where it was rendered.
struct RepeatedPass {
    bool isEqual = true; ///< in every bit, says the comparison
    RayCounts rays;
    double renderSeconds = 0.0;
    double compareSeconds = 0.0;
    Timeline timeline{}; ///< its dispatches; none of a reference renderer
    /// A copy of the film, while the pass is the last one.
    std::function<Film()> film{};
    /// The lane of its subgroup that computed a sample of a pixel of the whole image; empty where nobody knows. For any
    /// pass of the same film.
    std::function<std::optional<std::uint32_t>(const glm::uvec2 &, std::uint32_t)> laneOf{};
};

struct RepeatHooks {
    std::function<bool()> shouldStop{}; ///< ends a pass in its midst, which then does not count
    std::function<bool(const RepeatedPass &)> onPass{}; ///< after each pass; false: no further one
};

} // namespace hyalite::core
