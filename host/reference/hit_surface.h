// The surface at a ray hit. Twin: hitSurface in shaders/traversal/rays.glsl.
#pragma once

#include "host/reference/closest_hit.h"

namespace hyalite::reference {

/// Texture coordinates of a hit at `position`.
template <class Real>
[[nodiscard]] Vec2<Real> hitUv(const SceneView<Real> &scene, const Hit<Real> &hit,
                               const Vec3<Real> &position) {
    if (hit.primitive >= scene.frame.firstTriangleId)
        return triangleUv(fetchCoordinates(scene, hit.record), hit.u, hit.v);
    return sphereUv<Real>(position - scene.fetchSphere(hit.record).centre);
}

/// What the surface that a ray has met at `position` is made of.
template <class Real>
[[nodiscard]] MaterialRecord<Real> hitMaterial(const SceneView<Real> &scene, const Hit<Real> &hit,
                                               std::uint32_t materialIndex, const Vec3<Real> &position) {
    MaterialRecord<Real> material = scene.fetchMaterial(materialIndex);
    if (material.textures != 0)
        material = texturedMaterial(scene, material, hitUv(scene, hit, position));
    return material;
}

/// Applies the normal map of the material, if it has one; only then tangent() is called.
template <class Real, class TangentOf>
void mapNormal(const SceneView<Real> &scene, const Ray<Real> &ray, const Hit<Real> &hit,
               Surface<Real> &surface, std::uint32_t materialIndex, const TangentOf &tangentOf) {
    const std::uint32_t textures = scene.packed.materials[materialIndex].textures;
    if (textures == 0 || !hasTexture(scene, textures, layout::slotNormal))
        return;
    const Vec3<Real> mapped =
        mappedNormal(scene, surface.normal, tangentOf(), textureRow(textures, layout::slotNormal),
                     hitUv(scene, hit, surface.position));
    surface.normal = visibleNormal(ray.direction, mapped, surface.geometricNormal);
}

/// The surface at `hit`, a hit of `ray` with a primitive of the scene.
template <class Real>
[[nodiscard]] Surface<Real> hitSurface(const SceneView<Real> &scene, const Ray<Real> &ray,
                                       const Hit<Real> &hit, std::uint32_t &materialIndex) {
    if (hit.primitive >= scene.frame.firstTriangleId) {
        TriangleRecord<Real> triangle = scene.fetchTriangle(hit.record);
        NormalRecord<Real> normals = scene.fetchNormals(hit.record);
        if (hit.instance != layout::noInstance) {
            const InstanceRecord<Real> instance = scene.fetchInstance(hit.instance);
            triangle = placedTriangle(instance, triangle);
            normals = placedNormals(instance, normals);
        }
        materialIndex = triangle.materialIndex;
        Surface<Real> surface = triangleSurface(triangle, normals, hit.u, hit.v);
        mapNormal(scene, ray, hit, surface, materialIndex,
                  [&] { return triangleTangent(triangle, fetchCoordinates(scene, hit.record)); });
        return surface;
    }
    const SphereRecord<Real> sphere = scene.fetchSphere(hit.record);
    materialIndex = materialIndexOf(sphere);
    Surface<Real> surface = sphereSurface(ray.origin, ray.direction, hit.distance, sphere);
    mapNormal(scene, ray, hit, surface, materialIndex,
              [&] { return sphereTangent<Real>(surface.normal * normalSignOf(sphere)); });
    return surface;
}

} // namespace hyalite::reference
