// Radiance in a plain way: the oracle of the path integrator.
//
// It shares no code with the renderers, and nothing but the scene as plain data: double precision, its own geometry
// without a tree, its own random numbers, textbook BSDFs (plain_bsdf.h). Of what the renderers are clever about it has
// nothing: no choice of emitters by power, no multiple importance sampling, no choice of lobes, no Russian roulette, no
// tables beside those of energies. Where both agree, that cleverness changes no mean.
#pragma once

#include "host/scene/scene.h"
#include "tests/fixtures/test_scene.h"

#include <cstdint>

namespace hyalite::core::testing {

struct Estimate {
    glm::dvec3 mean{0.0};
    glm::dvec3 variance{0.0}; ///< of the mean
};

/// How paths find surfaces that emit. Lights without size are added up at each surface, and what is infinitely far away
/// is met by paths that leave the scene, with either.
enum class Search {
    ByAiming, ///< at one point of all emitters from each rough surface, chosen evenly by area; what a path meets after
              ///< that surface does not shine a second time
    ByScattering ///< paths meet them
};

/// Mean radiance over columns [x0, x1) and rows [y0, y1) of the image, from `pathCount` paths through points of it that
/// are distributed as the filter says. The result depends on the arguments alone. Of the settings it knows
/// `maxDepth` and `filter`.
[[nodiscard]] Estimate estimatePlainly(const TestScene &scene, int x0, int x1, int y0, int y1, int pathCount,
                                       std::uint64_t seed, Search search = Search::ByAiming);

} // namespace hyalite::core::testing
