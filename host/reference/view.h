// Views of what primary rays meet, and ambient occlusion. Twin: shaders/integrators/view.comp.
//
// Ambient occlusion is the share of a white sky that a point sees, weighted by the cosine to its normal, with
// everything further away than `occlusionDistance` left out: Zhukov, Iones and Kronin, "An Ambient Light Illumination
// Model", 1998.
//
// The shadow of a shadow catcher, and looking through mirrors and glass: the kernel's file says what they are.
#pragma once

#include "host/reference/specular.h"

#include <optional>

namespace hyalite::core::reference {

/// Traces camera samples to their first hits, or on through mirrors and glass. Each thread has its own instance, because
/// it keeps counts.
template <class Real, class Counter = NoCounter> class ViewIntegrator : public SpecularPath<Real, Counter> {
  public:
    /// `view` is one of layout::view...
    ViewIntegrator(const PackedScene &scene, const RenderSettings &settings)
        : Base(scene, settings, CarriesRadiance::No), view_(viewOf(settings)),
          looksThrough_(looksThrough(settings.integrator, settings)) {}

    /// What a sample of features has beside the albedo.
    struct Beside {
        Vec3<Real> normal; ///< as a colour
        Real depth;
    };

    /// Of the last sample; null of other views.
    [[nodiscard]] std::optional<Beside> features() const {
        return view_ == layout::viewFeatures ? std::optional(beside_) : std::nullopt;
    }

    /// The colour of one sample of a pixel of the whole image. `shift` moves the sample by this many pixels, to learn
    /// how the picture changes around it.
    [[nodiscard]] Vec3<Real> sampleRadiance(const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                            const Vec2<Real> &shift = Vec2<Real>(Real(0))) {
        Ray<Real> ray = beginPath(pixel, sampleIndex, shift);
        if (looksThrough_)
            enterMedia(ray.origin);
        ray.keys = {pixel, sampleIndex, 2};
        pathLength_ = 0;
        Hit<Real> hit;
        Surface<Real> surface;
        std::uint32_t materialIndex;
        for (;; ++depth_) {
            hit = traceToHit(ray);
            if (hit.primitive == layout::noPrimitive)
                return show(ofNothing());
            surface = hitSurface(scene_, hit, ray.origin, ray.direction, materialIndex);
            traceEvent(layout::traceSurfacePosition, 0, surface.position);
            traceEvent(layout::traceSurfaceNormal, 0, surface.normal);
            if (!looksThrough_)
                break;
            weaken(transmittance(hit.distance));
            const std::optional<Ray<Real>> next = lookThrough(ray, hit, surface, materialIndex);
            if (!next) {
                surface = facing(ray, surface);
                break;
            }
            ray = *next;
            ray.keys = {pixel, sampleIndex, 2 * (depth_ + 1)};
        }
        return show(ray, hit, surface, materialIndex);
    }

  private:
    using Base = SpecularPath<Real, Counter>;
    using Base::beginPath, Base::enterMedia, Base::isSpecularHere, Base::reflect,
        Base::scatterSmoothDielectric;
    using Base::isRefracted_, Base::counts_, Base::counter_;
    using Base::scene_, Base::pixel_, Base::sampleIndex_, Base::depth_, Base::throughput_;
    using Base::traceEvent, Base::traceRay, Base::transmittance, Base::vertexBits, Base::weaken;

    [[nodiscard]] Hit<Real> traceToHit(const Ray<Real> &ray) {
        traceRay(ray);
        const Hit<Real> hit = closestHit(scene_, ray, counter_);
        traceEvent(layout::traceHit, hit.primitive, {hit.distance, hit.u, hit.v});
        return hit;
    }

    [[nodiscard]] Vec3<Real> show(const Vec3<Real> &value) {
        traceEvent(layout::traceRadiance, 0, value);
        return value;
    }

    /// What a path that has left the scene shows: a normal has no length.
    [[nodiscard]] Vec3<Real> ofNothing() {
        beside_ = {normalColour(Vec3<Real>(Real(0))), Real(0)};
        if (looksThrough_ && view_ == layout::viewNormal)
            return normalColour(Vec3<Real>(Real(0)));
        return Vec3<Real>(Real(view_ == layout::viewOcclusion ? 1 : 0));
    }

    [[nodiscard]] Vec3<Real> show(const Ray<Real> &ray, const Hit<Real> &hit, const Surface<Real> &surface,
                                  std::uint32_t materialIndex) {
        const MaterialRecord<Real> material = hitMaterial(scene_, hit, scene_.fetchMaterial(materialIndex),
                                                          layout::texturesMaterials, surface.position);
        switch (view_) {
        case layout::viewNormal:
            return show(normalColour(surface.normal));
        case layout::viewDepth:
            return show(Vec3<Real>(pathLength_ + hit.distance));
        case layout::viewCoordinates: {
            const Vec2<Real> uv = hitUvs(scene_, hit, surface.position).first;
            return show({fractionOf(uv.x), fractionOf(uv.y), Real(0)});
        }
        case layout::viewId:
            return show(idColour<Real>(hit.primitive));
        case layout::viewFeatures:
        case layout::viewAlbedo: {
            beside_ = {normalColour(surface.normal), pathLength_ + hit.distance};
            const Real cosine = abs(dotProduct(ray.direction, surface.normal));
            const Vec3<Real> colour = albedoForViews(scene_, material, cosine);
            return show(looksThrough_ ? withoutTiny<Real>(throughput_ * colour) : colour);
        }
        case layout::viewShadow:
            return catchesShadows(material) ? catchShadow(facing(ray, surface), hit.primitive)
                                            : show(Vec3<Real>(Real(0)));
        case layout::viewObject:
        case layout::viewMaterial:
        case layout::viewAsset:
        case layout::viewPlace:
            return show(Vec3<Real>(Real(numberOf(scene_, view_, hit.primitive, materialIndex))));
        default:
            return seeSky(facing(ray, surface), hit.primitive);
        }
    }

    /// The next ray, if the surface is looked through.
    [[nodiscard]] std::optional<Ray<Real>> lookThrough(const Ray<Real> &ray, const Hit<Real> &hit,
                                                       const Surface<Real> &surface,
                                                       std::uint32_t materialIndex) {
        if (depth_ >= scene_.frame.maxDepth)
            return std::nullopt;
        const MaterialRecord<Real> material = hitMaterial(scene_, hit, scene_.fetchMaterial(materialIndex),
                                                          layout::texturesMaterials, surface.position);
        const bool isBehind = dotProduct(ray.direction, surface.geometricNormal) > 0;
        const bool isClear =
            isSpecularHere(material, materialIndex, !isBehind) || isLookedThrough(scene_, material);
        const bool isMixed = isMixture(scene_, material);
        if (!isClear || (isBehind && isMixed && isBlackBehind(scene_, material)))
            return std::nullopt;
        if (view_ == layout::viewDepth || view_ == layout::viewFeatures)
            static_cast<void>(show(Vec3<Real>(pathLength_ += hit.distance)));
        const bool isMetal = isLookedAtAsMetal(material);
        if (holdsMedium(scene_, material) && !isMetal) {
            const Ray<Real> next = scatterSmoothDielectric(ray, surface, materialIndex, hit.primitive);
            if (isRefracted_)
                weaken(glassTint(scene_, material));
            return next;
        }
        if (isThinGlass(scene_, material) && !isMetal)
            return scatterThinGlass(ray, surface, material, hit.primitive);
        const Real cosine = abs(dotProduct(ray.direction, surface.normal));
        weaken(isMixed ? metalReflectance(scene_, material, cosine)
                       : mirrorReflectance(scene_, material, cosine));
        return reflect(ray, surface, surface.normal, hit.primitive);
    }

    /// The next ray at thin glass, which is reflected or passes straight through.
    [[nodiscard]] Ray<Real> scatterThinGlass(const Ray<Real> &ray, const Surface<Real> &surface,
                                             const MaterialRecord<Real> &material, std::uint32_t primitive) {
        const Vec3<Real> reflectance =
            schlickReflectance(abs(dotProduct(ray.direction, surface.normal)),
                               dielectricReflectance(material), material.dielectricWeight);
        if (unitFloat<Real>(vertexBits(pairChoice).x) < largestComponent(reflectance))
            return reflect(ray, surface, surface.normal, primitive);
        weaken(glassTint(scene_, material));
        return {offsetRayOrigin(scene_, surface, ray.direction), ray.direction, primitive};
    }

    /// The surface as it is seen from the ray's side.
    [[nodiscard]] static Surface<Real> facing(const Ray<Real> &ray, Surface<Real> surface) {
        if (dotProduct(ray.direction, surface.geometricNormal) > 0) {
            surface.normal = -surface.normal;
            surface.geometricNormal = -surface.geometricNormal;
        }
        return surface;
    }

    [[nodiscard]] Vec3<Real> seeSky(const Surface<Real> &surface, std::uint32_t primitive) {
        const glm::uvec2 bits = sampleBits(pairKeys(pixel_, scene_.frame.seed, occlusionPair), sampleIndex_);
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

    /// On a shadow catcher: 1, the light of a sample, and what of it is blocked.
    [[nodiscard]] Vec3<Real> catchShadow(const Surface<Real> &surface, std::uint32_t primitive) {
        const EmitterChoice<Real> choice =
            chooseEmitter(scene_, {surface.position, surface.normal, false}, vertexBits(pairChoice).x);
        const LightSample<Real> light =
            sampleEmitter<Real>(scene_, choice, surface.position, vertexBits(pairLight));
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

    const std::uint32_t view_;
    const bool looksThrough_;
    Real pathLength_ = 0; ///< without the current segment
    Beside beside_{};
};

} // namespace hyalite::core::reference
