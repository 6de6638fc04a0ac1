// The surface at a ray hit. Twin: hitSurface in shaders/traversal/rays.glsl.
#pragma once

#include "host/reference/closest_hit.h"

#include <array>

namespace hyalite::reference {

/// Texture coordinates of a hit at `position`.
template <class Real>
[[nodiscard]] SurfaceUv<Real> hitUvs(const SceneView<Real> &scene, const Hit<Real> &hit,
                                     const Vec3<Real> &position) {
    if (hit.primitive >= scene.frame.firstTriangleId)
        return triangleUvs(scene, hit.record, hit.u, hit.v);
    const Vec2<Real> uv = sphereUv<Real>(position - scene.fetchSphere(hit.record).centre);
    return {uv, uv};
}

/// What the surface that a ray has met at `position` is made of.
template <class Real>
[[nodiscard]] MaterialRecord<Real> hitMaterial(const SceneView<Real> &scene, const Hit<Real> &hit,
                                               std::uint32_t materialIndex, const Vec3<Real> &position) {
    MaterialRecord<Real> material = scene.fetchMaterial(materialIndex);
    if (material.textures != 0)
        material = texturedMaterial(scene, material, layout::texturesMaterials, hitUvs(scene, hit, position));
    if ((scene.texturing & layout::texturesColours) != 0 && hit.primitive >= scene.frame.firstTriangleId)
        material = colouredMaterial(scene, material, hit.record, hit.u, hit.v);
    return material;
}

/// The triangle at a hit, in world space.
template <class Real>
[[nodiscard]] TriangleRecord<Real> hitTriangle(const SceneView<Real> &scene, const Hit<Real> &hit) {
    const TriangleRecord<Real> triangle = scene.fetchTriangle(hit.record);
    return hit.instance == layout::noInstance ? triangle
                                              : placedTriangle(scene.fetchInstance(hit.instance), triangle);
}

/// The surface at `hit`, a hit of `ray` with a primitive of the scene, without its normal map.
template <class Real>
[[nodiscard]] Surface<Real> smoothSurface(const SceneView<Real> &scene, const Ray<Real> &ray,
                                          const Hit<Real> &hit, std::uint32_t &materialIndex) {
    if (hit.primitive >= scene.frame.firstTriangleId) {
        const TriangleRecord<Real> triangle = hitTriangle(scene, hit);
        NormalRecord<Real> normals = scene.fetchNormals(hit.record);
        if (hit.instance != layout::noInstance)
            normals = placedNormals(scene.fetchInstance(hit.instance), normals);
        materialIndex = triangle.materialIndex;
        return triangleSurface(triangle, normals, hit.u, hit.v);
    }
    const SphereRecord<Real> sphere = scene.fetchSphere(hit.record);
    materialIndex = materialIndexOf(sphere);
    return sphereSurface(ray.origin, ray.direction, hit.distance, sphere);
}

/// Tangents at the hit, of textures with the second coordinates or the first. `normal` is that of the smooth surface.
template <class Real>
[[nodiscard]] Tangent<Real> hitTangent(const SceneView<Real> &scene, const Hit<Real> &hit,
                                       const Vec3<Real> &normal, bool isOfSecondUv) {
    if (hit.primitive < scene.frame.firstTriangleId)
        return sphereTangent<Real>(normal * normalSignOf(scene.fetchSphere(hit.record)));
    if ((scene.texturing & layout::texturesTangents) != 0) {
        const std::uint32_t row = tangentRow(scene, hit.record);
        std::array<Vec4<Real>, 3> corners{fetchTangent(scene, row), fetchTangent(scene, row + 1),
                                          fetchTangent(scene, row + 2)};
        if (hit.instance != layout::noInstance)
            for (Vec4<Real> &corner : corners)
                corner = placedTangent(scene.fetchInstance(hit.instance), corner);
        const Tangent<Real> tangent =
            vertexTangent<Real>(corners[0], corners[1], corners[2], normal, hit.u, hit.v);
        if (isKnown(tangent))
            return tangent;
    }
    const bool isSecond = isOfSecondUv && (scene.texturing & layout::texturesSecondUv) != 0;
    return triangleTangent(hitTriangle(scene, hit), isSecond ? fetchSecondCoordinates(scene, hit.record)
                                                             : fetchCoordinates(scene, hit.record));
}

/// The normal that the map in `slot` makes of that of a smooth surface.
template <class Real>
[[nodiscard]] Vec3<Real> hitNormal(const SceneView<Real> &scene, const Ray<Real> &ray, const Hit<Real> &hit,
                                   const Surface<Real> &surface, std::uint32_t textures, std::uint32_t slot) {
    if (textures == 0 || !hasTexture(scene, textures, slot))
        return surface.normal;
    const std::uint32_t row = textureRow(textures, slot);
    const Tangent<Real> tangent = hitTangent(scene, hit, surface.normal, usesSecondUv(scene, row));
    const Vec3<Real> mapped =
        mappedNormal(scene, surface.normal, tangent, row, hitUvs(scene, hit, surface.position));
    return visibleNormal(ray.direction, mapped, surface.geometricNormal);
}

/// The surface at `hit`.
template <class Real>
[[nodiscard]] Surface<Real> hitSurface(const SceneView<Real> &scene, const Ray<Real> &ray,
                                       const Hit<Real> &hit, std::uint32_t &materialIndex) {
    Surface<Real> surface = smoothSurface(scene, ray, hit, materialIndex);
    surface.normal = hitNormal(scene, ray, hit, surface, scene.packed.materials[materialIndex].textures,
                               layout::slotNormal);
    return surface;
}

/// What the material needs at the hit beyond `normal`, which is on the side of the viewer.
template <class Real>
[[nodiscard]] SurfaceAxes<Real> hitAxes(const SceneView<Real> &scene, const Ray<Real> &ray,
                                        const Hit<Real> &hit, const MaterialRecord<Real> &material,
                                        const Vec3<Real> &normal, bool isBehind) {
    SurfaceAxes<Real> axes{Vec3<Real>(Real(0)), normal};
    if ((scene.scattering & (layout::scattersAtAnisotropic | layout::scattersAtCoatNormals)) == 0)
        return axes;
    std::uint32_t materialIndex;
    const Surface<Real> surface = smoothSurface(scene, ray, hit, materialIndex);
    if ((scene.scattering & layout::scattersAtAnisotropic) != 0)
        axes.tangent = hitTangent(scene, hit, surface.normal, false).alongU;
    if ((scene.scattering & layout::scattersAtCoatNormals) != 0) {
        const Vec3<Real> coat =
            hitNormal(scene, ray, hit, surface, material.textures, layout::slotClearcoatNormal);
        axes.coatNormal = isBehind ? -coat : coat;
    }
    return axes;
}

} // namespace hyalite::reference
