// Conservative ray-box tests. Twin: shaders/geometry/box.glsl.
//
// How wide the pad must be. Let u be the unit of rounding and M the largest coordinate distance from the ray's origin
// to any box ("reach"). The triangle test moves the image of a vertex by at most 7 u M: one rounding of each of two
// translations, three of the shear, and one of the sum, which is at most 2 M. The slab test moves a plane by at most
// 4 u M: a difference, the pad, the inverse, a product. Together 11 u M: a pad of 16 u M covers it with room to spare.
//
// The test is monotone: whatever interval a box gives, a box around it gives no smaller one, to the bit, because each
// operation rounds monotonically. Triangle hits are confined to the interval of the triangle's own box (triangle.h),
// so no tree over the same triangles can lose or change a hit. Compare Ize, "Robust BVH Ray Traversal", JCGT 2(2),
// 2013, which widens the far distance only: enough for the slab test, not for the error of the triangle test.
#pragma once

#include "host/reference/vector.h"

namespace hyalite::reference {

template <class Real> struct BoxRay {
    Vec3<Real> origin;
    Real pad;           ///< widens every box on every side
    Vec3<Real> inverse; ///< 1 / direction, bounded
};

/// Distances along a ray, empty where enter > leave.
template <class Real> struct Interval {
    Real enter;
    Real leave;
};

/// `lower` and `upper` enclose all boxes that will be tested.
template <class Real>
[[nodiscard]] BoxRay<Real> makeBoxRay(const Vec3<Real> &origin, const Vec3<Real> &direction,
                                      const Vec3<Real> &lower, const Vec3<Real> &upper) {
    const Vec3<Real> toLower = absolute(lower - origin);
    const Vec3<Real> toUpper = absolute(upper - origin);
    const Real reach = largestComponent(greater(toLower, toUpper));
    // A direction of nearly 0 would give infinities and, on a face of the box, NaN. Bounded, it moves the ray by less
    // than the pad over any distance that occurs.
    const Real smallest = Real(1e-18);
    Vec3<Real> bounded = direction;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(direction[axis]) < smallest)
            bounded[axis] = direction[axis] < 0 ? -smallest : smallest;
    return {origin, Real(16) * roundingUnit<Real> * reach, Real(1) / bounded};
}

/// The distances at which the ray is inside of the box, from 0 on. The corners of this box are given relative to the
/// ray's origin.
template <class Real>
[[nodiscard]] Interval<Real> relativeBoxInterval(const BoxRay<Real> &ray, const Vec3<Real> &lower,
                                                 const Vec3<Real> &upper) {
    const Vec3<Real> toLower = (lower - ray.pad) * ray.inverse;
    const Vec3<Real> toUpper = (upper + ray.pad) * ray.inverse;
    const Real enter = greater(largestComponent(lesser(toLower, toUpper)), Real(0));
    const Real leave = smallestComponent(greater(toLower, toUpper));
    return {enter, leave};
}

template <class Real>
[[nodiscard]] Interval<Real> boxInterval(const BoxRay<Real> &ray, const Vec3<Real> &lower,
                                         const Vec3<Real> &upper) {
    return relativeBoxInterval<Real>(ray, lower - ray.origin, upper - ray.origin);
}

} // namespace hyalite::reference
