// Views of what primary rays meet, and ambient occlusion. Twin: shaders/integrators/view.comp.
//
// Ambient occlusion is the share of a white sky that a point sees, weighted by the cosine to its normal, with
// everything further away than `occlusionDistance` left out: Zhukov, Iones and Kronin, "An Ambient Light Illumination
// Model", 1998.
//
// The shadow of a shadow catcher: the kernel's file says what it is.
#pragma once

#include "host/film/ray_counts.h"
#include "host/reference/closest_hit.h"

#include <vector>

namespace hyalite::core::reference {

/// Traces camera samples to their first hits. Each thread has its own instance, because it keeps counts.
template <class Real, class Counter = NoCounter> class ViewIntegrator {
  public:
    /// `view` is one of layout::view...
    ViewIntegrator(const PackedScene &scene, const RenderSettings &settings)
        : scene_(scene, settings), view_(rowOf(settings.integrator).view) {}

    /// The colour of one sample of a pixel of the whole image. `shift` moves the sample by this many pixels, to learn
    /// how the picture changes around it.
    [[nodiscard]] Vec3<Real> sampleRadiance(const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                            const Vec2<Real> &shift = Vec2<Real>(Real(0))) {
        const PrimaryRay<Real> primary = primaryRayThrough<Real>(
            scene_, pixel, sampleOffset<Real>(scene_, pixel, sampleIndex) + shift, sampleIndex);
        ++counts_.primary;
        pixel_ = pixel;
        sampleIndex_ = sampleIndex;
        const Ray<Real> ray{primary.origin, primary.direction, layout::noPrimitive, {pixel, sampleIndex, 2}};
        depth_ = 1;
        const Hit<Real> hit = traceToHit(ray);
        if (hit.primitive == layout::noPrimitive)
            return show(Vec3<Real>(Real(view_ == layout::viewOcclusion ? 1 : 0)));
        std::uint32_t materialIndex;
        const Surface<Real> surface = hitSurface(scene_, hit, ray.origin, ray.direction, materialIndex);
        traceEvent(layout::traceSurfacePosition, 0, surface.position);
        traceEvent(layout::traceSurfaceNormal, 0, surface.normal);
        const MaterialRecord<Real> material = hitMaterial(scene_, hit, scene_.fetchMaterial(materialIndex),
                                                          layout::texturesMaterials, surface.position);
        switch (view_) {
        case layout::viewNormal:
            return show(normalColour(surface.normal));
        case layout::viewDepth:
            return show(Vec3<Real>(hit.distance));
        case layout::viewCoordinates: {
            const Vec2<Real> uv = hitUvs(scene_, hit, surface.position).first;
            return show({fractionOf(uv.x), fractionOf(uv.y), Real(0)});
        }
        case layout::viewId:
            return show(idColour<Real>(hit.primitive));
        case layout::viewAlbedo:
            return show(isColourless(material) ? Vec3<Real>(Real(1)) : Vec3<Real>(material.albedo));
        case layout::viewShadow:
            return catchesShadows(material) ? catchShadow(ray, surface, hit.primitive)
                                            : show(Vec3<Real>(Real(0)));
        case layout::viewObject:
        case layout::viewMaterial:
        case layout::viewAsset:
        case layout::viewPlace:
            return show(Vec3<Real>(Real(numberOf(scene_, view_, hit.primitive, materialIndex))));
        default:
            return seeSky(ray, surface, hit.primitive);
        }
    }

    [[nodiscard]] const RayCounts &counts() const { return counts_; }
    /// Of the traversal.
    [[nodiscard]] Counter &counter() { return counter_; }

    /// Appends all further events to `events`, which must outlive the integrator.
    void traceTo(std::vector<layout::TraceEvent> &events) { events_ = &events; }

  private:
    void traceEvent(std::uint32_t quantity, std::uint32_t integer, const Vec3<Real> &value) {
        if (events_ != nullptr)
            events_->push_back({quantity, sampleIndex_, depth_, integer, glm::vec3(value), 0});
    }

    [[nodiscard]] Hit<Real> traceToHit(const Ray<Real> &ray) {
        traceEvent(layout::traceRayOrigin, 0, ray.origin);
        traceEvent(layout::traceRayDirection, 0, ray.direction);
        const Hit<Real> hit = closestHit(scene_, ray, counter_);
        traceEvent(layout::traceHit, hit.primitive, {hit.distance, hit.u, hit.v});
        return hit;
    }

    [[nodiscard]] Vec3<Real> show(const Vec3<Real> &value) {
        traceEvent(layout::traceRadiance, 0, value);
        return value;
    }

    /// The surface as it is seen from the ray's side.
    [[nodiscard]] static Surface<Real> facing(const Ray<Real> &ray, Surface<Real> surface) {
        if (dotProduct(ray.direction, surface.geometricNormal) > 0) {
            surface.normal = -surface.normal;
            surface.geometricNormal = -surface.geometricNormal;
        }
        return surface;
    }

    [[nodiscard]] Vec3<Real> seeSky(const Ray<Real> &ray, const Surface<Real> &seen,
                                    std::uint32_t primitive) {
        const Surface<Real> surface = facing(ray, seen);
        const glm::uvec2 bits = bitsOf(occlusionPair);
        const Vec3<Real> direction = sampleCosine(surface.normal, unitFloats<Real>(bits));
        if (!(dotProduct(surface.geometricNormal, direction) > 0))
            return Vec3<Real>(Real(0));
        ++counts_.shadow;
        const Ray<Real> toSky{
            offsetRayOrigin(scene_, surface, direction), direction, primitive, {pixel_, sampleIndex_, 3}};
        const Real length = static_cast<Real>(scene_.frame.occlusionDistance);
        const bool isBlocked = isAnythingBefore(scene_, toSky, length, layout::noPrimitive, counter_);
        traceEvent(layout::traceVisibility, isBlocked ? layout::visibilityBlocked : layout::visibilityClear,
                   Vec3<Real>(Real(0)));
        return isBlocked ? Vec3<Real>(Real(0)) : show(Vec3<Real>(Real(1)));
    }

    [[nodiscard]] glm::uvec2 bitsOf(std::uint32_t pair) const {
        return sampleBits(pairKeys(pixel_, scene_.frame.seed, pair), sampleIndex_);
    }

    /// On a shadow catcher: 1, the light of a sample, and what of it is blocked.
    [[nodiscard]] Vec3<Real> catchShadow(const Ray<Real> &ray, const Surface<Real> &seen,
                                         std::uint32_t primitive) {
        const Surface<Real> surface = facing(ray, seen);
        const EmitterChoice<Real> choice = chooseEmitter(scene_, {surface.position, surface.normal, false},
                                                         bitsOf(vertexPair(1, pairChoice)).x);
        const LightSample<Real> light =
            sampleEmitter<Real>(scene_, choice, surface.position, bitsOf(vertexPair(1, pairLight)));
        const Real cosine = dotProduct(surface.normal, light.direction);
        const bool isLit = cosine > 0 && dotProduct(surface.geometricNormal, light.direction) > 0;
        const Real unblocked = isLit ? withoutTiny(luminance(light.radiance) * cosine) : Real(0);
        static_cast<void>(show({Real(1), unblocked, unblocked}));
        if (!(unblocked > 0))
            return {Real(1), unblocked, unblocked};
        ++counts_.shadow;
        depth_ = 2;
        return followToLight(surface, light, primitive, unblocked);
    }

    /// Passes glass and other shadow catchers on the way to the light.
    [[nodiscard]] Vec3<Real> followToLight(Surface<Real> surface, const LightSample<Real> &light,
                                           std::uint32_t primitive, Real unblocked) {
        bool isDimmed = false;
        for (Real left = light.distance;;) {
            const Ray<Real> ray{offsetRayOrigin(scene_, surface, light.direction),
                                light.direction,
                                primitive,
                                {pixel_, sampleIndex_, 2 * depth_}};
            const Hit<Real> hit = traceToHit(ray);
            if (hit.primitive == layout::noPrimitive || hit.distance >= left ||
                hit.primitive == light.target) {
                traceEvent(layout::traceVisibility,
                           isDimmed ? layout::visibilityDimmed : layout::visibilityClear,
                           Vec3<Real>(Real(0)));
                const Real blocked =
                    isDimmed ? unblocked * (Real(1) - scene_.frame.shadowThroughGlass) : Real(0);
                return show({Real(1), unblocked, blocked});
            }
            std::uint32_t materialIndex;
            surface = hitSurface(scene_, hit, ray.origin, ray.direction, materialIndex);
            const MaterialRecord<Real> material = scene_.fetchMaterial(materialIndex);
            const bool isDimming = isGlass(scene_, material) || isThinGlass(scene_, material);
            if (!isDimming && !catchesShadows(material)) {
                traceEvent(layout::traceVisibility, layout::visibilityBlocked, Vec3<Real>(Real(0)));
                return {Real(1), unblocked, unblocked};
            }
            isDimmed = isDimmed || isDimming;
            primitive = hit.primitive;
            left -= hit.distance;
        }
    }

    const SceneView<Real> scene_;
    const std::uint32_t view_;
    RayCounts counts_;
    Counter counter_;
    std::vector<layout::TraceEvent> *events_ = nullptr;
    glm::uvec2 pixel_{0};
    std::uint32_t sampleIndex_ = 0;
    std::uint32_t depth_ = 1; ///< segment number of the current ray
};

} // namespace hyalite::core::reference
