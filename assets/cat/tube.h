// Limbs as chains of tapered capsules along a smooth curve.
#pragma once

#include "assets/cat/implicit.h"

#include <vector>

namespace hyalite::cat {

struct TubeShape {
    Vec3 stretch{1.0, 1.0, 1.0}; // of the cross-section, along the axes of `axes`
    Frame axes;                  // its origin is unused
    int stepsPerSpan = 6;        // capsules between two knots
    double blend = 0.6;          // rounds the inner side of bends
};

// Balls along a Catmull-Rom curve through the knots (E. Catmull and R. Rom, 1974), the radius going as smoothly as
// the centre.
[[nodiscard]] std::vector<Ball> smoothCurve(const std::vector<Ball> &knots, int stepsPerSpan);

void addTube(Part &part, const std::vector<Ball> &knots, const TubeShape &shape);

} // namespace hyalite::cat
