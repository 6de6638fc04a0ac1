// Watertight ray-triangle intersection. Twin: shaders/geometry/triangle.glsl, which explains why it is watertight.
#pragma once

#include "host/reference/box.h"

namespace hyalite::reference {

template <class Real> struct TriangleRay {
    Vec3<Real> origin;
    int axis;         ///< the largest component of the direction: 0, 1, 2
    Vec3<Real> shear; ///< direction[x]/direction[z], direction[y]/direction[z], 1/direction[z], with z = axis
};

template <class Real> struct TriangleHit {
    Real distance; ///< not positive: no hit
    Real u;        ///< weights of the first and the second vertex
    Real v;
};

/// Rotates components so that the given axis becomes z.
template <class Real> [[nodiscard]] Vec3<Real> axisToZ(const Vec3<Real> &v, int axis) {
    if (axis == 0)
        return {v.y, v.z, v.x};
    return axis == 1 ? Vec3<Real>(v.z, v.x, v.y) : v;
}

template <class Real>
[[nodiscard]] TriangleRay<Real> makeTriangleRay(const Vec3<Real> &origin, const Vec3<Real> &direction) {
    const Vec3<Real> size = absolute(direction);
    const int axis = size.z >= size.x && size.z >= size.y ? 2 : (size.y >= size.x ? 1 : 0);
    const Vec3<Real> along = axisToZ(direction, axis);
    const Real inverse = Real(1) / along.z;
    return {origin, axis, {along.x * inverse, along.y * inverse, inverse}};
}

/// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
template <class Real>
[[nodiscard]] TriangleHit<Real> intersectTriangle(const TriangleRay<Real> &ray, const BoxRay<Real> &boxRay,
                                                  const Vec3<Real> &v0, const Vec3<Real> &v1,
                                                  const Vec3<Real> &v2) {
    const Vec3<Real> to0 = v0 - ray.origin;
    const Vec3<Real> to1 = v1 - ray.origin;
    const Vec3<Real> to2 = v2 - ray.origin;
    const Vec3<Real> a = axisToZ(to0, ray.axis);
    const Vec3<Real> b = axisToZ(to1, ray.axis);
    const Vec3<Real> c = axisToZ(to2, ray.axis);
    const Vec2<Real> shear(ray.shear);
    const Vec2<Real> p = Vec2<Real>(a) - shear * a.z;
    const Vec2<Real> q = Vec2<Real>(b) - shear * b.z;
    const Vec2<Real> r = Vec2<Real>(c) - shear * c.z;
    const Real e0 = r.x * q.y - r.y * q.x;
    const Real e1 = p.x * r.y - p.y * r.x;
    const Real e2 = q.x * p.y - q.y * p.x;
    const Real least = lesser(lesser(e0, e1), e2);
    const Real greatest = greater(greater(e0, e1), e2);
    const bool isInside = lesser(greatest, -least) <= 0; // least >= 0 or greatest <= 0
    const Real determinant = e0 + e1 + e2;
    const Real inverse = Real(1) / determinant;
    const Real u = e0 * inverse;
    const Real v = e1 * inverse;
    const Real w = e2 * inverse;
    const Real depth = (u * a.z + v * b.z + w * c.z) * ray.shear.z;
    const Interval<Real> interval =
        relativeBoxInterval(boxRay, lesser(lesser(to0, to1), to2), greater(greater(to0, to1), to2));
    const Real distance = lesser(greater(depth, interval.enter), interval.leave);
    const bool isHit = isInside && determinant != 0 && interval.enter <= interval.leave;
    return {isHit ? distance : Real(0), u, v};
}

/// The point with weights u, v, 1-u-v on a triangle.
template <class Real>
[[nodiscard]] Vec3<Real> trianglePoint(const Vec3<Real> &v0, const Vec3<Real> &v1, const Vec3<Real> &v2,
                                       Real u, Real v) {
    const Real w = Real(1) - u - v;
    return v0 * u + v1 * v + v2 * w;
}

/// How far trianglePoint may lie off the plane, as a bound for each coordinate: Pharr, Jakob and Humphreys, "Physically
/// Based Rendering", section 6.8.5, with 8 units of rounding in place of gamma(7). And how far a neighbour in the same
/// plane may seem to lie off it: its depth is uncertain by units of its size, for which this triangle's stands.
template <class Real>
[[nodiscard]] Vec3<Real> trianglePointError(const Vec3<Real> &v0, const Vec3<Real> &v1, const Vec3<Real> &v2,
                                            Real u, Real v) {
    const Real w = Real(1) - u - v;
    const Real extent = largestComponent(greater(absolute(v1 - v0), absolute(v2 - v0)));
    const Vec3<Real> size = absolute(v0 * u) + absolute(v1 * v) + absolute(v2 * w) + extent;
    return size * (Real(8) * roundingUnit<Real>);
}

} // namespace hyalite::reference
