#include "assets/cat/tube.h"

#include <cassert>

namespace hyalite::cat {
namespace {

Ball mix(const Ball &a, double weightA, const Ball &b, double weightB) {
    return {a.centre * weightA + b.centre * weightB, a.radius * weightA + b.radius * weightB};
}

} // namespace

std::vector<Ball> smoothCurve(const std::vector<Ball> &knots, int stepsPerSpan) {
    assert(knots.size() >= 2);
    const std::size_t last = knots.size() - 1;
    std::vector<Ball> curve;
    for (std::size_t span = 0; span < last; ++span) {
        const Ball &a = knots[span];
        const Ball &b = knots[span + 1];
        // Beyond the ends the curve goes on straight.
        const Ball before = span > 0 ? knots[span - 1] : mix(a, 2.0, b, -1.0);
        const Ball after = span + 1 < last ? knots[span + 2] : mix(b, 2.0, a, -1.0);
        for (int step = 0; step < stepsPerSpan; ++step) {
            const double t = static_cast<double>(step) / stepsPerSpan;
            const double t2 = t * t;
            const double t3 = t2 * t;
            const Ball outer = mix(before, 0.5 * (2.0 * t2 - t - t3), after, 0.5 * (t3 - t2));
            const Ball inner = mix(a, 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0), b, 0.5 * (4.0 * t2 + t - 3.0 * t3));
            curve.push_back(mix(outer, 1.0, inner, 1.0));
        }
    }
    curve.push_back(knots[last]);
    return curve;
}

void addTube(Part &part, const std::vector<Ball> &knots, const TubeShape &shape) {
    const std::vector<Ball> curve = smoothCurve(knots, shape.stepsPerSpan);
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
        part.primitives.push_back(
            Primitive::taperedCapsule(curve[i], curve[i + 1], shape.stretch, shape.axes));
    part.innerBlend = shape.blend;
}

} // namespace hyalite::cat
