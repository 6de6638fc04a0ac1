// The glass around the origin of a primary ray. Twin: shaders/integrators/media_at_origin.glsl.
#pragma once

#include "host/reference/closest_hit.h"

namespace hyalite::core::reference {

/// Counts of glass as in shaders/bsdf/media.glsl. `onRay` is told of each ray on the way.
template <class Real, class Counter, class OnRay>
[[nodiscard]] std::uint32_t mediaAtOrigin(const SceneView<Real> &scene, const Vec3<Real> &origin,
                                          const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                          Counter &counter, const OnRay &onRay) {
    std::uint32_t media = scene.frame.mediaAtEye;
    if ((scene.camera & layout::cameraOriginsMeetGlass) == 0)
        return media;
    Ray<Real> ray{
        Vec3<Real>(scene.frame.eye), Vec3<Real>(Real(0)), layout::noPrimitive, {pixel, sampleIndex, 0}};
    for (;;) {
        const WayToOrigin<Real> way = wayToOrigin<Real>(scene, ray.origin, origin);
        if (!(way.distance > 0))
            return media;
        ray.direction = way.direction;
        onRay(ray);
        const Hit<Real> hit = closestHit(scene, ray, counter);
        if (hit.primitive == layout::noPrimitive || hit.distance >= way.distance)
            return media;
        std::uint32_t materialIndex;
        const Surface<Real> surface = hitSurface(scene, hit, ray.origin, ray.direction, materialIndex);
        if (holdsMedium(scene, scene.fetchMaterial(materialIndex)))
            media = dotProduct(ray.direction, surface.geometricNormal) < 0
                        ? enterMedium(media, materialIndex)
                        : leaveMedium(media, materialIndex);
        ray.origin = offsetRayOrigin(scene, surface, ray.direction);
        ray.excluded = hit.primitive;
    }
}

} // namespace hyalite::core::reference
