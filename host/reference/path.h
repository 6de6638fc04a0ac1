// The path integrator: one path per sample, with next-event estimation at diffuse and rough surfaces, multiple
// importance sampling of light samples and scattered rays, and Russian roulette. Kajiya, "The Rendering Equation",
// SIGGRAPH 1986; Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, sections 9 and 10. Twin:
// shaders/integrators/path.comp. Here a path is followed vertex by vertex; the order of all sums is the same.
//
// `maxDepth` bounds the segments of a path from the eye to the light, so that neither technique finds longer paths than
// the other. Each vertex has pairs of random numbers of its own (shaders/math/dimensions.glsl).
#pragma once

#include "host/film/ray_counts.h"
#include "host/reference/closest_hit.h"
#include "host/reference/media_at_origin.h"
#include "host/reference/transparency.h"

#include <bit>
#include <optional>
#include <vector>

namespace hyalite::core::reference {

/// Traces camera samples through the scene. Each thread has its own instance, because it keeps counts.
template <class Real, class Counter = NoCounter> class PathIntegrator {
  public:
    PathIntegrator(const PackedScene &scene, const RenderSettings &settings)
        : scene_(scene, settings), transparency_(alphaKindOf(settings)) {}

    /// Radiance of one sample of a pixel of the whole image. `shift` moves the sample by this many pixels, to learn how
    /// the picture changes around it.
    [[nodiscard]] Vec3<Real> sampleRadiance(const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                            const Vec2<Real> &shift = Vec2<Real>(Real(0))) {
        const PrimaryRay<Real> primary = primaryRayThrough<Real>(
            scene_, pixel, sampleOffset<Real>(scene_, pixel, sampleIndex) + shift, sampleIndex);
        ++counts_.primary;
        pixel_ = pixel;
        sampleIndex_ = sampleIndex;
        radiance_ = Vec3<Real>(Real(0));
        throughput_ = Vec3<Real>(Real(1));
        scatterPdf_ = 0;
        transparency_.begin();
        depth_ = 0;
        mediaInside_ = mediaAtOrigin(scene_, primary.origin, pixel, sampleIndex, counter_,
                                     [&](const Ray<Real> &ray) { traceRay(ray); });
        depth_ = 1;
        std::optional<Ray<Real>> ray = Ray<Real>{primary.origin, primary.direction};
        while (ray) {
            ray = followRay(*ray);
            ++depth_;
        }
        return radiance_;
    }

    /// Of that sample.
    [[nodiscard]] Real transparency() const { return transparency_.ofSample(); }

    [[nodiscard]] const RayCounts &counts() const { return counts_; }
    /// Of the traversal.
    [[nodiscard]] Counter &counter() { return counter_; }

    /// Appends all further events to `events`, which must outlive the integrator.
    void traceTo(std::vector<layout::TraceEvent> &events) { events_ = &events; }

  private:
    static constexpr std::uint32_t firstRouletteDepth = 4; // every path may have this many segments

    void traceEvent(std::uint32_t quantity, std::uint32_t integer, const Vec3<Real> &value) {
        if (events_ != nullptr)
            events_->push_back({quantity, sampleIndex_, depth_, integer, glm::vec3(value), 0});
    }

    void traceRay(const Ray<Real> &ray) {
        traceEvent(layout::traceRayOrigin, 0, ray.origin);
        traceEvent(layout::traceRayDirection, 0, ray.direction);
    }

    [[nodiscard]] glm::uvec2 vertexBits(std::uint32_t pair) const {
        const std::uint32_t number = vertexPair(depth_, pair);
        return sampleBits(pairKeys(pixel_, scene_.frame.seed, number), sampleIndex_);
    }

    [[nodiscard]] Vec2<Real> lobeChoice() const {
        const std::uint32_t number = lobePair(depth_);
        return unitFloats<Real>(sampleBits(pairKeys(pixel_, scene_.frame.seed, number), sampleIndex_));
    }

    void addRadiance(const Vec3<Real> &weight, const Vec3<Real> &radiance) {
        Vec3<Real> added = withoutTiny<Real>(weight * radiance);
        if (depth_ > 1)
            added = lesser(added, Vec3<Real>(static_cast<Real>(scene_.frame.radianceLimit)));
        radiance_ = radiance_ + added;
        traceEvent(layout::traceRadiance, 0, radiance_);
    }

    void weaken(const Vec3<Real> &factor) { throughput_ = withoutTiny<Real>(throughput_ * factor); }

    /// Adds the emission of the surface that the ray has hit, with the multiple importance weight against sampling that
    /// point as a light.
    void addEmission(const Ray<Real> &ray, const Hit<Real> &hit, const Surface<Real> &surface,
                     const MaterialRecord<Real> &material) {
        const Real facing = -dotProduct(ray.direction, surface.geometricNormal);
        const Real cosine = emitsBehind(material) ? abs(facing) : facing;
        if (material.emitterPdf <= 0 || cosine <= 0)
            return;
        Real weight = 1;
        if (scatterPdf_ > 0) {
            Real pdf;
            if (isTriangle(scene_, hit.primitive)) {
                const std::uint32_t emitter =
                    scene_.packed.triangles[hit.record].flags >> layout::triangleEmitterShift;
                const Real areaPdf = pdfOfEmitter<Real>(scene_, emitter, material.emitterPdf, litPoint_);
                pdf = solidAnglePdf(areaPdf, hit.distance, cosine);
            } else {
                const layout::SphereRecord &sphere = scene_.packed.spheres[hit.record];
                const Real areaPdf =
                    pdfOfEmitter<Real>(scene_, sphere.emitter, material.emitterPdf, litPoint_);
                pdf = pdfSphereLight(ray.origin, ray.direction, hit.distance, Vec3<Real>(sphere.centre),
                                     static_cast<Real>(sphere.radius),
                                     surface.normal * static_cast<Real>(normalSignOf(sphere)), areaPdf);
            }
            weight = powerHeuristic(scatterPdf_, pdf);
        }
        addRadiance(throughput_ * weight, Vec3<Real>(material.emission));
    }

    /// Adds the background or the environment, which has a multiple importance weight against sampling it as a light.
    void addEnvironment(const Ray<Real> &ray) {
        if ((scene_.lighting & layout::lightsByEnvironment) == 0) {
            addRadiance(throughput_, Vec3<Real>(scene_.frame.background));
            return;
        }
        const EnvironmentLight<Real> found = environmentFrom(scene_, ray.direction);
        const Real pdf = found.pdf * static_cast<Real>(scene_.frame.environmentProbability);
        const Real weight = scatterPdf_ > 0 ? powerHeuristic(scatterPdf_, pdf) : Real(1);
        addRadiance(throughput_ * weight, found.radiance);
    }

    /// Transmittance of the glass around the path, over this distance.
    [[nodiscard]] Vec3<Real> transmittance(Real distance) const {
        const std::uint32_t medium = mediumAround(mediaInside_);
        return medium != layout::noMaterial
                   ? expNegative<Real>(Vec3<Real>(scene_.packed.materials[medium].absorption) * distance)
                   : Vec3<Real>(Real(1));
    }

    [[nodiscard]] Real mediumIndex(std::uint32_t medium) const {
        return medium != layout::noMaterial
                   ? static_cast<Real>(scene_.packed.materials[medium].refractiveIndex)
                   : Real(1);
    }

    /// Russian roulette: ends long paths of low throughput at random and raises the weight of the survivors. Returns
    /// whether the path survives.
    [[nodiscard]] bool survivesRoulette() {
        if (depth_ < firstRouletteDepth)
            return true;
        const Real index = mediumIndex(mediumAround(mediaInside_));
        // Radiance in glass is larger by the square of the refractive index; the path loses that factor on its way out.
        const Real survival = lesser(largestComponent(throughput_) * (index * index), Real(1));
        if (unitFloat<Real>(vertexBits(pairChoice).y) >= survival)
            return false;
        throughput_ *= Real(1) / survival;
        return true;
    }

    [[nodiscard]] Ray<Real> reflect(const Ray<Real> &ray, const Surface<Real> &surface,
                                    const Vec3<Real> &normal, std::uint32_t primitive) {
        const Vec3<Real> direction = mirrorDirection(ray.direction, normal);
        scatterPdf_ = 0;
        transparency_.endSeeingThrough();
        ++counts_.reflection;
        return {offsetRayOrigin(scene_, surface, direction), direction, primitive};
    }

    /// The media on both sides of a glass surface.
    struct Crossing {
        std::uint32_t before; ///< medium counts as in shaders/bsdf/media.glsl
        std::uint32_t beyond;
        Real eta;             ///< refractive index before divided by the one beyond
        bool isNullInterface; ///< the same glass is effective on both sides
    };

    [[nodiscard]] Crossing crossingOf(std::uint32_t materialIndex, bool isEntering) const {
        // Glass that is left without having been entered changes nothing: paths begin in what is around the eye.
        const std::uint32_t before = mediaInside_;
        const std::uint32_t beyond =
            isEntering ? enterMedium(before, materialIndex) : leaveMedium(before, materialIndex);
        const std::uint32_t medium = mediumAround(before);
        const std::uint32_t mediumBeyond = mediumAround(beyond);
        return {before, beyond, mediumIndex(medium) / mediumIndex(mediumBeyond), medium == mediumBeyond};
    }

    /// The next ray at smooth glass. It passes straight on if the same glass is effective on both sides; otherwise it
    /// is reflected or refracted, chosen with the probability of the reflectance.
    [[nodiscard]] Ray<Real> scatterSmoothDielectric(const Ray<Real> &ray, const Surface<Real> &surface,
                                                    std::uint32_t materialIndex, std::uint32_t primitive) {
        const bool isEntering = dotProduct(ray.direction, surface.geometricNormal) < 0;
        const Crossing crossing = crossingOf(materialIndex, isEntering);
        if (crossing.isNullInterface) {
            mediaInside_ = crossing.beyond;
            scatterPdf_ = 0; // light is never sampled through glass
            return {offsetRayOrigin(scene_, surface, ray.direction), ray.direction, primitive};
        }
        const Vec3<Real> geometricFacing = isEntering ? surface.geometricNormal : -surface.geometricNormal;
        const Vec3<Real> shadingFacing = isEntering ? surface.normal : -surface.normal;
        const Vec3<Real> facing =
            dotProduct(ray.direction, shadingFacing) < 0 ? shadingFacing : geometricFacing;
        const Real eta = crossing.eta;
        const DielectricFresnel<Real> glass = fresnelDielectric(ray.direction, facing, eta);
        traceEvent(layout::traceReflectance, glass.reflectance == 1 ? 1 : 0, Vec3<Real>(glass.reflectance));
        if (unitFloat<Real>(vertexBits(pairChoice).x) < glass.reflectance) {
            mediaInside_ = crossing.before;
            return reflect(ray, surface, facing, primitive);
        }
        mediaInside_ = crossing.beyond;
        throughput_ *= eta * eta;
        scatterPdf_ = 0;
        ++counts_.refraction;
        return {offsetRayOrigin(scene_, surface, glass.refracted), glass.refracted, primitive};
    }

    /// Whether the material is specular here: a mirror or clear glass. Rough glass with the same index on both sides is
    /// clear.
    [[nodiscard]] bool isSpecularHere(const MaterialRecord<Real> &material, std::uint32_t materialIndex,
                                      bool isEntering) const {
        if (isGlass(scene_, material) && material.alpha > 0) {
            const Crossing crossing = crossingOf(materialIndex, isEntering);
            return crossing.isNullInterface || crossing.eta == Real(1);
        }
        return isSpecular(material);
    }

    /// The next ray of the path; empty at its end.
    [[nodiscard]] std::optional<Ray<Real>> followRay(Ray<Real> ray) {
        ray.keys = {pixel_, sampleIndex_, 2 * depth_};
        traceRay(ray);
        const Hit<Real> hit = closestHit(scene_, ray, counter_);
        traceEvent(layout::traceHit, hit.primitive, {hit.distance, hit.u, hit.v});
        weaken(transmittance(hit.distance));
        if (hit.primitive == layout::noPrimitive) {
            if (transparency_.seesThrough())
                transparency_.become(throughput_);
            else
                addEnvironment(ray);
            return std::nullopt;
        }
        std::uint32_t materialIndex;
        Surface<Real> surface = hitSurface(scene_, hit, ray.origin, ray.direction, materialIndex);
        const MaterialRecord<Real> material = hitMaterial(scene_, hit, scene_.fetchMaterial(materialIndex),
                                                          layout::texturesMaterials, surface.position);
        traceEvent(layout::traceSurfacePosition, 0, surface.position);
        traceEvent(layout::traceSurfaceNormal, 0, surface.normal);
        traceEvent(layout::traceThroughput, 0, throughput_);
        if (transparency_.seesThrough() && catchesShadows(material)) {
            transparency_.become(throughput_);
            return std::nullopt;
        }
        transparency_.meetSurface();
        if (showsBaseColour(scene_, material)) {
            addRadiance(throughput_, material.albedo);
            return std::nullopt;
        }
        addEmission(ray, hit, surface, material);
        if (depth_ >= scene_.frame.maxDepth)
            return std::nullopt;
        const bool isBehind = dotProduct(ray.direction, surface.geometricNormal) > 0;
        if (!isSpecularHere(material, materialIndex, !isBehind)) {
            if (isBehind) {
                if (isBlackBehind(scene_, material))
                    return std::nullopt;
                surface.normal = -surface.normal;
                surface.geometricNormal = -surface.geometricNormal;
            }
            return scatterAt(ray, hit, surface, material, materialIndex, isBehind);
        }
        if (!survivesRoulette())
            return std::nullopt;
        if (isGlass(scene_, material))
            return scatterSmoothDielectric(ray, surface, materialIndex, hit.primitive);
        weaken(mirrorReflectance(scene_, material, abs(dotProduct(ray.direction, surface.normal))));
        return reflect(ray, surface, surface.normal, hit.primitive);
    }

    /// At a surface that scatters: samples a light and the next direction.
    [[nodiscard]] std::optional<Ray<Real>> scatterAt(const Ray<Real> &ray, const Hit<Real> &hit,
                                                     const Surface<Real> &surface,
                                                     const MaterialRecord<Real> &material,
                                                     std::uint32_t materialIndex, bool isBehind) {
        const std::uint32_t primitive = hit.primitive;
        const Crossing crossing = isGlass(scene_, material)
                                      ? crossingOf(materialIndex, !isBehind)
                                      : Crossing{mediaInside_, mediaInside_, Real(1), true};
        const Vec2<Real> lobe = lobeChoice();
        const SurfaceAxes<Real> axes =
            hitAxes(scene_, hit, ray.origin, ray.direction, material, surface.normal, isBehind);
        const Bsdf<Real> bsdf = makeBsdf<Real>(scene_, material, ray.direction, surface.normal,
                                               surface.geometricNormal, axes, isBehind, crossing.eta, lobe.x);

        litPoint_ = {surface.position, surface.normal,
                     isLitFromBehind<Real>(scene_, scene_.fetchMaterial(materialIndex))};
        const EmitterChoice<Real> choice = chooseEmitter(scene_, litPoint_, vertexBits(pairChoice).x);
        const std::uint32_t emitter = choice.index;
        const LightSample<Real> light =
            sampleEmitter<Real>(scene_, choice, surface.position, vertexBits(pairLight));
        const Vec3<Real> wiLight = toLocal(bsdf.frame, light.direction);
        const bool isLightBeyond = dotProduct(surface.geometricNormal, light.direction) <= 0;
        const BsdfEval<Real> lit = evalBsdf(scene_, bsdf, wiLight);
        // What shines through is seen by the scattered ray, as what it is.
        const bool isWindow = transparency_.seesThroughGlass() && isClearGlass(scene_, material);
        const auto isSeenAnyway = [&] {
            return isWindow && isLightBeyond &&
                   scene_.fetchEmitter(emitter).kind == layout::emitterEnvironment;
        };
        const bool isLit = largestComponent(light.radiance) > 0 && lit.pdf > 0 &&
                           isLightBeyond == (wiLight.z <= 0) && !isSeenAnyway();
        if (isLit) {
            const Real share = light.pdf > 0 ? powerHeuristic(light.pdf, lit.pdf) : Real(1);
            mediaInside_ = isLightBeyond ? crossing.beyond : crossing.before;
            const Vec3<Real> weight = throughput_ * (light.radiance * (lit.value * share));
            aimShadowRay(surface, emitter, light, weight * transmittance(light.distance), primitive);
        } else {
            skipShadowRay(emitter);
        }

        const Vec3<Real> wi = sampleBsdf(scene_, bsdf, unitFloats<Real>(vertexBits(pairScatter)), lobe.y);
        const Vec3<Real> direction = unitVector(toWorld(bsdf.frame, wi));
        const BsdfEval<Real> scattered = evalBsdf(scene_, bsdf, wi);
        const bool isBeyond = dotProduct(surface.geometricNormal, direction) <= 0;
        const bool isPossible = scattered.pdf > 0 && isBeyond == (wi.z <= 0);
        mediaInside_ = isBeyond ? crossing.beyond : crossing.before;
        scatterPdf_ = isPossible ? scattered.pdf : Real(0);
        if (!(isWindow && isBeyond))
            transparency_.endSeeingThrough();
        if (isPossible)
            weaken(scattered.value * (Real(1) / scattered.pdf));
        return scatter(surface, direction, primitive);
    }

    /// Continues the path from a surface.
    [[nodiscard]] std::optional<Ray<Real>> scatter(const Surface<Real> &surface, const Vec3<Real> &direction,
                                                   std::uint32_t primitive) {
        if (!(scatterPdf_ > 0) || !survivesRoulette())
            return std::nullopt;
        traceEvent(layout::traceScatter, std::bit_cast<std::uint32_t>(static_cast<float>(scatterPdf_)),
                   direction);
        ++counts_.bounce;
        return Ray<Real>{offsetRayOrigin(scene_, surface, direction), direction, primitive};
    }

    void skipShadowRay(std::uint32_t emitter) {
        traceEvent(layout::traceVisibility, layout::visibilityUnlit, Vec3<Real>(static_cast<Real>(emitter)));
    }

    /// Sends a shadow ray to what was chosen.
    void aimShadowRay(const Surface<Real> &surface, std::uint32_t emitter, const LightSample<Real> &light,
                      const Vec3<Real> &weight, std::uint32_t primitive) {
        ++counts_.shadow;
        const Ray<Real> ray{offsetRayOrigin(scene_, surface, light.direction),
                            light.direction,
                            primitive,
                            {pixel_, sampleIndex_, 2 * depth_ + 1}};
        const bool isBlocked = isAnythingBefore(scene_, ray, light.distance, light.target, counter_);
        traceEvent(layout::traceVisibility, isBlocked ? layout::visibilityBlocked : layout::visibilityClear,
                   Vec3<Real>(static_cast<Real>(emitter)));
        if (!isBlocked)
            addRadiance(weight, Vec3<Real>(Real(1)));
    }

    const SceneView<Real> scene_;
    glm::uvec2 pixel_{0};
    std::uint32_t sampleIndex_ = 0;
    std::uint32_t depth_ = 0; ///< segment number of the current ray
    Vec3<Real> radiance_{Real(0)};
    Vec3<Real> throughput_{Real(1)};
    Transparency<Real> transparency_;
    LitPoint<Real> litPoint_{};     ///< where the current ray was scattered
    Real scatterPdf_ = 0;           ///< of the current ray, per solid angle; 0: direction not sampled
    std::uint32_t mediaInside_ = 0; ///< medium counts: see shaders/bsdf/media.glsl
    RayCounts counts_;
    Counter counter_;
    std::vector<layout::TraceEvent> *events_ = nullptr;
};

} // namespace hyalite::core::reference
