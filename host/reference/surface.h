// Points on surfaces and the rays that leave them. Twin: shaders/geometry/surface.glsl.
#pragma once

#include "host/reference/triangle.h"
#include "shaders/layout/layout.h"

namespace hyalite::reference {

template <class Real> struct Surface {
    Vec3<Real> position;
    Vec3<Real> error;           ///< bound on the rounding error of the position
    Vec3<Real> normal;          ///< for shading, unit length
    Vec3<Real> geometricNormal; ///< of the real surface, unit length, on the side of `normal`
};

template <class Real>
[[nodiscard]] Surface<Real> sphereSurface(const Vec3<Real> &origin, const Vec3<Real> &direction,
                                          Real distance, const layout::SphereRecord &sphere) {
    const Vec3<Real> position = origin + direction * distance;
    const Vec3<Real> outward = position - Vec3<Real>(sphere.centre);
    const Vec3<Real> normal = unitVector(outward) * static_cast<Real>(normalSignOf(sphere));
    return {position, Vec3<Real>(Real(0)), normal, normal};
}

template <class Real>
[[nodiscard]] Surface<Real> triangleSurface(const layout::TriangleRecord &triangle,
                                            const layout::NormalRecord &normals, Real u, Real v) {
    const Vec3<Real> v0(triangle.v0);
    const Vec3<Real> v1(triangle.v1);
    const Vec3<Real> v2(triangle.v2);
    const Vec3<Real> area = crossProduct<Real>(v1 - v0, v2 - v0);
    // Scaled first, as the square of a small or of a giant area leaves the range of floats. No area: no light.
    const Real largest = largestComponent(absolute(area));
    const Vec3<Real> geometric =
        largest > 0 ? unitVector<Real>(area * (Real(1) / largest)) : Vec3<Real>(Real(0));
    const Vec3<Real> blended =
        trianglePoint(Vec3<Real>(normals.n0), Vec3<Real>(normals.n1), Vec3<Real>(normals.n2), u, v);
    const Vec3<Real> normal = dotProduct(blended, blended) > 0 ? unitVector(blended) : geometric;
    Surface<Real> surface;
    surface.position = trianglePoint(v0, v1, v2, u, v);
    surface.error = trianglePointError(v0, v1, v2, u, v);
    surface.normal = normal;
    surface.geometricNormal = dotProduct(geometric, normal) < 0 ? -geometric : geometric;
    return surface;
}

/// Where a ray leaves the surface in `direction`: moved along the geometric normal by twice the error bound, to the
/// side that the ray goes to (Wächter and Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray
/// Tracing Gems, chapter 6, and PBRT section 6.8.6, name the problem; the bound is PBRT's). Spheres need no offset.
template <class Real>
[[nodiscard]] Vec3<Real> spawnPoint(const Surface<Real> &surface, const Vec3<Real> &direction,
                                    bool hasTriangles = true) {
    if (!hasTriangles)
        return surface.position; // the same, unless the normal is NaN
    const Real distance = Real(2) * dotProduct<Real>(absolute(surface.geometricNormal), surface.error);
    const Real side = dotProduct(direction, surface.geometricNormal) < 0 ? -distance : distance;
    return surface.position + surface.geometricNormal * side;
}

} // namespace hyalite::reference
