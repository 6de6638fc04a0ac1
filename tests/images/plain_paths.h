// Radiance in a plain way: paths bounce by the cosine of their angle, and from each surface one point of all lights is
// looked at, chosen evenly by area. What a bounce hits does not shine a second time.
//
// It shares no code with the renderers: double precision, its own geometry without a tree, its own random numbers. Of
// what they are clever about it has nothing: no choice by power, no weights of two ways to sample, no Russian roulette.
// Where both agree, that cleverness changes no mean.
#pragma once

#include "host/scene/scene.h"

#include <cstdint>

namespace hyalite::testing {

struct Estimate {
    glm::dvec3 mean{0.0};
    glm::dvec3 variance{0.0}; ///< of the mean
};

/// Mean radiance over columns [x0, x1) and rows [y0, y1) of the image, from `pathCount` paths through uniformly
/// distributed points of it. `scene` has triangles of diffuse materials only, without normals of their own, some of
/// which emit. The result depends on the arguments alone.
[[nodiscard]] Estimate estimatePlainly(const Scene &scene, int x0, int x1, int y0, int y1, int pathCount,
                                       std::uint64_t seed);

} // namespace hyalite::testing
