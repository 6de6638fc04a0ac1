// The Whitted integrator: direct light with shadows on diffuse surfaces, and both branches at glass, all deterministic.
// Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980.
// Twin: shaders/integrators/whitted.comp. Here a path is followed ray by ray; the order of all sums is the same.
#pragma once

#include "host/film/ray_counts.h"
#include "host/reference/closest_hit.h"
#include "host/reference/media_at_origin.h"
#include "host/reference/transparency.h"

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace hyalite::core::reference {

/// Traces camera samples through the scene. Each thread has its own instance, because it keeps waiting rays and counts.
template <class Real, class Counter = NoCounter> class WhittedIntegrator {
  public:
    WhittedIntegrator(const PackedScene &scene, const RenderSettings &settings)
        : scene_(scene, settings, counter_.readsOf()), transparency_(alphaKindOf(settings)) {}

    /// Radiance of one sample of a pixel of the whole image. `shift` moves the sample by this many pixels, to learn how
    /// the picture changes around it.
    [[nodiscard]] Vec3<Real> sampleRadiance(const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                            const Vec2<Real> &shift = Vec2<Real>(Real(0))) {
        const PrimaryRay<Real> primary = primaryRayThrough<Real>(
            scene_, pixel, sampleOffset<Real>(scene_, pixel, sampleIndex) + shift, sampleIndex);
        const RayCounts countsBefore = counts_;
        ++counts_.primary;
        pixel_ = pixel;
        sampleIndex_ = sampleIndex;
        radiance_ = Vec3<Real>(Real(0));
        transparency_.begin();
        depth_ = 0;
        const std::uint32_t media = mediaAtOrigin(scene_, primary.origin, pixel, sampleIndex, counter_,
                                                  [&](const Ray<Real> &ray) { traceRay(ray); });
        pending_.push_back(
            {{primary.origin, primary.direction}, Vec3<Real>(Real(1)), 1, mediumAround(media)});
        for (std::uint64_t segmentCount = 1; !pending_.empty(); ++segmentCount) {
            if (segmentCount % segmentsBetweenPolls == 0 && isToStop_ && isToStop_()) {
                pending_.clear();
                counts_ = countsBefore;
                isAbandoned_ = true;
                break;
            }
            const Segment segment = pending_.back();
            pending_.pop_back();
            if (segment.isReflected)
                transparency_.endSeeingThrough();
            followSegment(segment);
        }
        return radiance_;
    }

    /// Glass makes a sample a tree of up to 2^maxDepth segments. If `isToStop` returns true within one, the sample is
    /// abandoned: its radiance is none, and its rays are not counted.
    void stopWhen(std::function<bool()> isToStop) { isToStop_ = std::move(isToStop); }
    [[nodiscard]] bool isAbandoned() const { return isAbandoned_; }

    /// Of that sample.
    [[nodiscard]] Real transparency() const { return transparency_.ofSample(); }

    [[nodiscard]] const RayCounts &counts() const { return counts_; }
    /// Of the traversal.
    [[nodiscard]] Counter &counter() { return counter_; }

    /// Appends all further events to `events`, which must outlive the integrator.
    void traceTo(std::vector<layout::TraceEvent> &events) { events_ = &events; }

  private:
    static constexpr std::uint64_t segmentsBetweenPolls = 4096;

    struct Segment {
        Ray<Real> ray;
        Vec3<Real> throughput;
        std::uint32_t depth;  ///< 1 for a primary ray
        std::uint32_t medium; ///< material of the glass around the segment, or noMaterial
        bool isReflected = false;
    };

    void traceEvent(std::uint32_t quantity, std::uint32_t integer, const Vec3<Real> &value) {
        if (events_ != nullptr)
            events_->push_back({quantity, sampleIndex_, depth_, integer, glm::vec3(value), 0});
    }

    void traceRay(const Ray<Real> &ray) {
        traceEvent(layout::traceRayOrigin, 0, ray.origin);
        traceEvent(layout::traceRayDirection, 0, ray.direction);
    }

    void followSegment(Segment segment) {
        depth_ = segment.depth;
        traceRay(segment.ray);
        segment.ray.keys = {pixel_, sampleIndex_, 2 * depth_};
        const Hit<Real> hit = closestHit(scene_, segment.ray, counter_);
        traceEvent(layout::traceHit, hit.primitive, {hit.distance, hit.u, hit.v});
        if (hit.primitive == layout::noPrimitive) {
            counter_.arrive(scene_, depth_, hit.primitive, 0);
            if (segment.medium != layout::noMaterial)
                tint(segment, segment.medium);
            if (transparency_.seesThrough())
                transparency_.become(segment.throughput);
            else
                radiance_ = radiance_ + segment.throughput * radianceAround(segment.ray.direction);
            traceEvent(layout::traceRadiance, 0, radiance_);
            return;
        }
        std::uint32_t materialIndex;
        const Surface<Real> surface =
            hitSurface(scene_, hit, segment.ray.origin, segment.ray.direction, materialIndex);
        counter_.arrive(scene_, depth_, hit.primitive, materialIndex);
        const MaterialRecord<Real> material = hitMaterial(scene_, hit, scene_.fetchMaterial(materialIndex),
                                                          layout::texturesMaterials, surface.position);
        const bool isEntering = dotProduct(segment.ray.direction, surface.normal) < 0;
        const bool isClear = isGlassForWhitted(material);
        const std::uint32_t medium = isClear && !isEntering ? materialIndex : segment.medium;
        if (medium != layout::noMaterial)
            tint(segment, medium);

        traceEvent(layout::traceSurfacePosition, 0, surface.position);
        traceEvent(layout::traceSurfaceNormal, 0, surface.normal);
        traceEvent(layout::traceThroughput, 0, segment.throughput);
        if (transparency_.seesThrough() && catchesShadows(material)) {
            transparency_.become(segment.throughput);
            return;
        }
        transparency_.meetSurface();
        if (showsBaseColour(scene_, material)) {
            radiance_ = radiance_ + segment.throughput * material.albedo;
            traceEvent(layout::traceRadiance, 0, radiance_);
            return;
        }
        const bool isSeenFromFront = dotProduct(segment.ray.direction, surface.geometricNormal) < 0;
        if (scene_.hasEmission && (isSeenFromFront || emitsBehind(material))) {
            radiance_ = radiance_ + segment.throughput * Vec3<Real>(material.emission);
            traceEvent(layout::traceRadiance, 0, radiance_);
        }
        if (isDiffuseForWhitted(scene_, material))
            shadeDiffuse(segment, surface, material, hit.primitive);
        else if (segment.depth < scene_.frame.maxDepth && isClear)
            splitAtGlass(segment, surface, material.refractiveIndex, materialIndex, isEntering,
                         hit.primitive);
        else if (segment.depth < scene_.frame.maxDepth) {
            counter_.scatter(Lobe::Mirror);
            reflect(segment, surface,
                    withoutTiny<Real>(segment.throughput * mirrorReflectanceForWhitted(scene_, material)),
                    segment.medium, hit.primitive);
        }
    }

    /// Takes from the segment what its glass absorbs.
    void tint(Segment &segment, std::uint32_t medium) const {
        segment.throughput =
            withoutTiny<Real>(segment.throughput * Vec3<Real>(scene_.packed.materials[medium].segmentTint));
    }

    /// Radiance of rays that leave the scene.
    [[nodiscard]] Vec3<Real> radianceAround(const Vec3<Real> &direction) const {
        if ((scene_.lighting & layout::lightsByEnvironment) != 0)
            return environmentRadianceAt(scene_, environmentPlace(scene_, direction));
        return Vec3<Real>(scene_.frame.background);
    }

    void shadeDiffuse(const Segment &segment, Surface<Real> surface, const MaterialRecord<Real> &material,
                      std::uint32_t primitive) {
        if (isTwoSided(material) && dotProduct(segment.ray.direction, surface.geometricNormal) > 0) {
            surface.normal = -surface.normal;
            surface.geometricNormal = -surface.geometricNormal;
        }
        counter_.scatter(Lobe::Diffuse);
        const Vec3<Real> weight = segment.throughput * (Vec3<Real>(material.albedo) * inversePi<Real>);
        for (const layout::LightRecord &light : scene_.packed.lights) {
            counter_.lookAtLight();
            const Vec3<Real> toLight = Vec3<Real>(light.position) - surface.position;
            const bool isDirectional = light.kind == layout::lightDirectional;
            const Real distance = isDirectional ? unboundedDistance<Real> : vectorLength(toLight);
            const Vec3<Real> direction =
                isDirectional ? -Vec3<Real>(light.axis) : toLight * (Real(1) / distance);
            const bool isLit = dotProduct(surface.normal, direction) > 0 &&
                               dotProduct(surface.geometricNormal, direction) > 0;
            const Vec3<Real> lightIndex(static_cast<Real>(&light - scene_.packed.lights.data()));
            if (!isLit) {
                traceEvent(layout::traceVisibility, layout::visibilityUnlit, lightIndex);
                continue;
            }
            ++counts_.shadow;
            const Ray<Real> ray{offsetRayOrigin(scene_, surface, direction),
                                direction,
                                primitive,
                                {pixel_, sampleIndex_, 2 * depth_ + 1}};
            const Shadow shadow = castShadowRay(scene_, ray, distance, counter_);
            counter_.followShadowRay();
            traceEvent(layout::traceVisibility,
                       shadow.isBlocked  ? layout::visibilityBlocked
                       : shadow.isDimmed ? layout::visibilityDimmed
                                         : layout::visibilityClear,
                       lightIndex);
            if (shadow.isBlocked)
                continue;
            const Real squaredDistance = distance * distance;
            const Real cosine = dotProduct(surface.normal, direction);
            Vec3<Real> irradiance =
                Vec3<Real>(light.intensity) * (isDirectional ? cosine : cosine / squaredDistance);
            if (light.kind == layout::lightSpot)
                irradiance *=
                    spotFalloff(direction, Vec3<Real>(light.axis), static_cast<Real>(light.cosineOuter),
                                static_cast<Real>(light.falloffScale));
            if (lightKindOf(light) == layout::lightProfiled)
                irradiance *=
                    spotFalloff(direction, Vec3<Real>(light.axis), static_cast<Real>(light.cosineOuter),
                                static_cast<Real>(light.falloffScale)) *
                    profileShare(scene_, profileOf(light), direction, Vec3<Real>(light.axis));
            Vec3<Real> reflected = weight * irradiance;
            if (shadow.isDimmed)
                reflected *= static_cast<Real>(scene_.frame.shadowThroughGlass);
            radiance_ = radiance_ + reflected;
            traceEvent(layout::traceRadiance, 0, radiance_);
        }
    }

    void reflect(const Segment &segment, const Surface<Real> &surface, const Vec3<Real> &throughput,
                 std::uint32_t medium, std::uint32_t primitive) {
        const Vec3<Real> direction = mirrorDirection(segment.ray.direction, surface.normal);
        ++counts_.reflection;
        pending_.push_back({{offsetRayOrigin(scene_, surface, direction), direction, primitive},
                            throughput,
                            segment.depth + 1,
                            medium,
                            true});
    }

    void splitAtGlass(const Segment &segment, const Surface<Real> &surface, Real refractiveIndex,
                      std::uint32_t materialIndex, bool isEntering, std::uint32_t primitive) {
        counter_.scatter(Lobe::ClearGlass);
        const Vec3<Real> facing = isEntering ? surface.normal : -surface.normal;
        const Refraction<Real> refraction =
            refractRay(segment.ray.direction, facing, refractiveIndex, isEntering);
        traceEvent(layout::traceReflectance, refraction.isTotal ? 1 : 0, Vec3<Real>(refraction.reflectance));
        const std::uint32_t mediumOfReflection = isEntering ? segment.medium : materialIndex;
        if (refraction.isTotal) {
            reflect(segment, surface, segment.throughput, mediumOfReflection, primitive);
            return;
        }
        // The refracted ray is followed first.
        reflect(segment, surface, segment.throughput * refraction.reflectance, mediumOfReflection, primitive);
        ++counts_.refraction;
        pending_.push_back(
            {{offsetRayOrigin(scene_, surface, refraction.direction), refraction.direction, primitive},
             segment.throughput * refraction.transmittance,
             segment.depth + 1,
             isEntering ? materialIndex : layout::noMaterial});
    }

    Counter counter_; ///< before the view, which counts there
    const SceneView<Real> scene_;
    std::vector<Segment> pending_;
    Vec3<Real> radiance_{Real(0)};
    Transparency<Real> transparency_;
    RayCounts counts_;
    std::function<bool()> isToStop_;
    bool isAbandoned_ = false;
    std::vector<layout::TraceEvent> *events_ = nullptr;
    glm::uvec2 pixel_{0};
    std::uint32_t sampleIndex_ = 0; ///< sample and depth of the current segment
    std::uint32_t depth_ = 0;
};

} // namespace hyalite::core::reference
