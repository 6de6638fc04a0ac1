// The surface that a ray has met. Twin: hitSurface in shaders/rays.glsl.
#pragma once

#include "host/reference/closest_hit.h"
#include "host/reference/surface.h"

namespace hyalite::reference {

/// `hit` is one of `ray` with a primitive of the scene.
template <class Real>
[[nodiscard]] Surface<Real> hitSurface(const PackedScene &scene, const Ray<Real> &ray, const Hit<Real> &hit,
                                       std::uint32_t &materialIndex) {
    if (hit.primitive >= layout::firstTriangleId) {
        const layout::TriangleRecord &triangle = scene.triangles[hit.record];
        materialIndex = triangle.materialIndex;
        return triangleSurface(triangle, scene.normals[hit.record], hit.u, hit.v);
    }
    const layout::SphereRecord &sphere = scene.spheres[hit.record];
    materialIndex = sphere.materialIndex;
    return sphereSurface(ray.origin, ray.direction, hit.distance, sphere);
}

} // namespace hyalite::reference
