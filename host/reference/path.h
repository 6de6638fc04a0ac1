// The path integrator: one path per sample, with next-event estimation at diffuse and rough surfaces, multiple
// importance sampling of light samples and scattered rays, and Russian roulette. Kajiya, "The Rendering Equation",
// SIGGRAPH 1986; Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, sections 9 and 10. Twin:
// shaders/integrators/path.comp. Here a path is followed vertex by vertex; the order of all sums is the same.
//
// `maxDepth` bounds the segments of a path from the eye to the light, so that neither technique finds longer paths than
// the other. Each vertex has pairs of random numbers of its own (shaders/math/dimensions.glsl).
#pragma once

#include "host/reference/specular.h"

#include <bit>
#include <optional>
#include <vector>

namespace hyalite::core::reference {

/// Traces camera samples through the scene. Each thread has its own instance, because it keeps counts.
template <class Real, class Counter = NoCounter> class PathIntegrator : public SpecularPath<Real, Counter> {
  public:
    PathIntegrator(const PackedScene &scene, const RenderSettings &settings)
        : Base(scene, settings, CarriesRadiance::Yes) {}

    /// Radiance of one sample of a pixel of the whole image. `shift` moves the sample by this many pixels, to learn how
    /// the picture changes around it.
    [[nodiscard]] Vec3<Real> sampleRadiance(const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                            const Vec2<Real> &shift = Vec2<Real>(Real(0))) {
        radiance_ = Vec3<Real>(Real(0));
        std::optional<Ray<Real>> ray = beginPath(pixel, sampleIndex, shift);
        enterMedia(ray->origin);
        while (ray) {
            ray = followRay(*ray);
            ++depth_;
        }
        return radiance_;
    }

    /// Of that sample.
    [[nodiscard]] Real transparency() const { return transparency_.ofSample(); }
    /// By planes of the film.
    [[nodiscard]] std::vector<Vec3<Real>> light() const { return light_.planes(); }

  private:
    using Base = SpecularPath<Real, Counter>;
    using Base::beginPath, Base::enterMedia, Base::crossingOf, Base::disperse, Base::isReflectedWhole,
        Base::waveOfSample, Base::isSpecularHere, Base::mediumIndex, Base::reflect;
    using Base::scatterPdf_, Base::mediaInside_, Base::isDispersed_, Base::counts_, Base::counter_;
    using Base::scatterSmoothDielectric, Base::traceEvent, Base::traceRay, Base::transmittance;
    using Base::scene_, Base::pixel_, Base::sampleIndex_, Base::depth_, Base::throughput_,
        Base::transparency_, Base::light_;
    using Base::vertexBits, Base::weaken;
    using typename Base::Crossing;

    static constexpr std::uint32_t firstRouletteDepth = 4; // every path may have this many segments

    /// The lobe that sampleBsdf() samples with this choice.
    [[nodiscard]] static Lobe lobeOf(const Bsdf<Real> &bsdf, Real choice) {
        switch (bsdf.kind) {
        case bsdfGlass:
            return Lobe::RoughGlass;
        case bsdfSheen:
            return Lobe::Sheen;
        case bsdfOpaque:
            if (choice < bsdf.specularProbability)
                return Lobe::Glossy;
            if (choice < bsdf.specularProbability + bsdf.thinProbability)
                return Lobe::Thin;
            return choice < Real(1) - bsdf.diffuseTransmissionProbability ? Lobe::Diffuse
                                                                          : Lobe::DiffuseTransmission;
        default:
            return Lobe::Diffuse;
        }
    }

    [[nodiscard]] Vec2<Real> lobeChoice() const {
        const std::uint32_t number = lobePair(depth_);
        return unitFloats<Real>(sampleBits(pairKeys(pixel_, scene_.frame.seed, number), sampleIndex_));
    }

    /// Returns what the sample has gained.
    Vec3<Real> addRadiance(const Vec3<Real> &weight, const Vec3<Real> &radiance) {
        Vec3<Real> added = withoutTiny<Real>(weight * radiance);
        if (depth_ > 1)
            added = lesser(added, Vec3<Real>(static_cast<Real>(scene_.frame.radianceLimit)));
        radiance_ = radiance_ + added;
        traceEvent(layout::traceRadiance, 0, radiance_);
        return added;
    }

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
        const Vec3<Real> added = addRadiance(throughput_ * weight, Vec3<Real>(material.emission));
        light_.addMet(added, layout::lightEmission, material.lightGroup);
    }

    /// Adds the background or the environment, which has a multiple importance weight against sampling it as a light.
    void addEnvironment(const Ray<Real> &ray) {
        if ((scene_.lighting & layout::lightsByEnvironment) == 0) {
            const Vec3<Real> added = addRadiance(throughput_, Vec3<Real>(scene_.frame.background));
            light_.addMet(added, layout::lightBackground, scene_.frame.environmentGroup);
            return;
        }
        const EnvironmentLight<Real> found = environmentFrom(scene_, ray.direction);
        const Real pdf = found.pdf * static_cast<Real>(scene_.frame.environmentProbability);
        const Real weight = scatterPdf_ > 0 ? powerHeuristic(scatterPdf_, pdf) : Real(1);
        const Vec3<Real> added = addRadiance(throughput_ * weight, found.radiance);
        light_.addMet(added, layout::lightBackground, scene_.frame.environmentGroup);
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

    /// The next ray of the path; empty at its end.
    [[nodiscard]] std::optional<Ray<Real>> followRay(Ray<Real> ray) {
        ray.keys = {pixel_, sampleIndex_, 2 * depth_};
        traceRay(ray);
        const Hit<Real> hit = closestHit(scene_, ray, counter_);
        traceEvent(layout::traceHit, hit.primitive, {hit.distance, hit.u, hit.v});
        weaken(transmittance(hit.distance));
        if (hit.primitive == layout::noPrimitive) {
            counter_.arrive(scene_, depth_, hit.primitive, 0);
            if (transparency_.seesThrough())
                transparency_.become(throughput_);
            else
                addEnvironment(ray);
            return std::nullopt;
        }
        std::uint32_t materialIndex;
        Surface<Real> surface = hitSurface(scene_, hit, ray.origin, ray.direction, materialIndex);
        counter_.arrive(scene_, depth_, hit.primitive, materialIndex);
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
            const Vec3<Real> added = addRadiance(throughput_, material.albedo);
            light_.addMet(added, layout::lightEmission, material.lightGroup);
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
        counter_.scatter(holdsMedium(scene_, material) ? Lobe::ClearGlass : Lobe::Mirror);
        if (holdsMedium(scene_, material))
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
        const Crossing crossing = holdsMedium(scene_, material)
                                      ? crossingOf(materialIndex, !isBehind)
                                      : Crossing{mediaInside_, mediaInside_, Real(1), true, false};
        if (crossing.isDispersing && !isReflectedWhole(crossing, true))
            disperse();
        const Vec2<Real> lobe = lobeChoice();
        const SurfaceAxes<Real> axes =
            hitAxes(scene_, hit, ray.origin, ray.direction, material, surface.normal, isBehind);
        Bsdf<Real> bsdf = makeBsdf<Real>(scene_, material, ray.direction, surface.normal,
                                         surface.geometricNormal, axes, isBehind, crossing.eta, lobe.x);
        if (crossing.isDispersing && !isDispersed_)
            bsdf.tint = bsdf.tint * waveOfSample().colour;

        litPoint_ = {surface.position, surface.normal,
                     isLitFromBehind<Real>(scene_, scene_.fetchMaterial(materialIndex))};
        counter_.lookAtLight();
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
            if (isLightThere(surface, emitter, light, primitive)) {
                const Vec3<Real> added =
                    addRadiance(weight * transmittance(light.distance), Vec3<Real>(Real(1)));
                if (light_.areKept())
                    light_.addSampled(added, diffuseShare(scene_, bsdf, wiLight, lit.value), isLightBeyond,
                                      lightGroupOf(scene_.fetchEmitter(emitter)));
            }
        } else {
            skipShadowRay(emitter);
        }

        const Vec3<Real> wi = sampleBsdf(scene_, bsdf, unitFloats<Real>(vertexBits(pairScatter)), lobe.y);
        counter_.scatter(lobeOf(bsdf, lobe.y));
        const Vec3<Real> direction = unitVector(toWorld(bsdf.frame, wi));
        const BsdfEval<Real> scattered = evalBsdf(scene_, bsdf, wi);
        const bool isBeyond = dotProduct(surface.geometricNormal, direction) <= 0;
        const bool isPossible = scattered.pdf > 0 && isBeyond == (wi.z <= 0);
        mediaInside_ = isBeyond ? crossing.beyond : crossing.before;
        scatterPdf_ = isPossible ? scattered.pdf : Real(0);
        if (crossing.isDispersing && isBeyond && bsdf.kind == bsdfGlass)
            isDispersed_ = true;
        if (!(isWindow && isBeyond))
            transparency_.endSeeingThrough();
        if (light_.areKept())
            light_.scatter(diffuseShare(scene_, bsdf, wi, scattered.value), isBeyond);
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

    /// Sends a shadow ray to what was chosen. Returns whether it arrives.
    [[nodiscard]] bool isLightThere(const Surface<Real> &surface, std::uint32_t emitter,
                                    const LightSample<Real> &light, std::uint32_t primitive) {
        ++counts_.shadow;
        const Ray<Real> ray{offsetRayOrigin(scene_, surface, light.direction),
                            light.direction,
                            primitive,
                            {pixel_, sampleIndex_, 2 * depth_ + 1}};
        const bool isBlocked = isAnythingBefore(scene_, ray, light.distance, light.target, counter_);
        counter_.followShadowRay();
        traceEvent(layout::traceVisibility, isBlocked ? layout::visibilityBlocked : layout::visibilityClear,
                   Vec3<Real>(static_cast<Real>(emitter)));
        return !isBlocked;
    }

    Vec3<Real> radiance_{Real(0)};
    LitPoint<Real> litPoint_{}; ///< where the current ray was scattered
};

} // namespace hyalite::core::reference
