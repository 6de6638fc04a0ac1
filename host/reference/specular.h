// Specular surfaces, mirrors and smooth glass, on paths that choose one direction at each. Twin:
// shaders/integrators/specular.glsl.
#pragma once

#include "host/film/ray_counts.h"
#include "host/reference/closest_hit.h"
#include "host/reference/light_layers.h"
#include "host/reference/media_at_origin.h"
#include "host/reference/transparency.h"

#include <vector>

namespace hyalite::core::reference {

/// Whether throughputs are of radiance, which is larger in glass by the square of the refractive index; those of colours
/// are not.
enum class CarriesRadiance : bool { No, Yes };

/// A path of camera samples, as integrators follow it. Each thread has its own instance, because it keeps counts.
template <class Real, class Counter> class SpecularPath {
  public:
    [[nodiscard]] const RayCounts &counts() const { return counts_; }
    /// Of the traversal.
    [[nodiscard]] Counter &counter() { return counter_; }

    /// Appends all further events to `events`, which must outlive the integrator.
    void traceTo(std::vector<layout::TraceEvent> &events) { events_ = &events; }

  protected:
    SpecularPath(const PackedScene &scene, const RenderSettings &settings, CarriesRadiance carriesRadiance)
        : scene_(scene, settings, counter_.readsOf()),
          carriesRadiance_(carriesRadiance == CarriesRadiance::Yes), transparency_(alphaKindOf(settings)),
          light_(lightPlanesOf(scene, settings)) {}

    /// The primary ray of a sample, `shift` pixels away from its place.
    [[nodiscard]] Ray<Real> beginPath(const glm::uvec2 &pixel, std::uint32_t sampleIndex,
                                      const Vec2<Real> &shift) {
        const PrimaryRay<Real> primary = primaryRayThrough<Real>(
            scene_, pixel, sampleOffset<Real>(scene_, pixel, sampleIndex) + shift, sampleIndex);
        ++counts_.primary;
        pixel_ = pixel;
        sampleIndex_ = sampleIndex;
        throughput_ = Vec3<Real>(Real(1));
        scatterPdf_ = 0;
        isDispersed_ = false;
        transparency_.begin();
        light_.begin();
        depth_ = 1;
        return {primary.origin, primary.direction};
    }

    /// Finds the glass around the origin of the primary ray.
    void enterMedia(const Vec3<Real> &origin) {
        depth_ = 0;
        mediaInside_ = mediaAtOrigin(scene_, origin, pixel_, sampleIndex_, counter_,
                                     [&](const Ray<Real> &ray) { traceRay(ray); });
        depth_ = 1;
    }

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

    void weaken(const Vec3<Real> &factor) { throughput_ = withoutTiny<Real>(throughput_ * factor); }

    /// Transmittance of the glass around the path, over this distance.
    [[nodiscard]] Vec3<Real> transmittance(Real distance) const {
        const std::uint32_t medium = mediumAround(mediaInside_);
        return medium != layout::noMaterial
                   ? expNegative<Real>(Vec3<Real>(scene_.packed.materials[medium].absorption) * distance)
                   : Vec3<Real>(Real(1));
    }

    [[nodiscard]] bool dispersesLight() const {
        return carriesRadiance_ && (scene_.packed.scattering & layout::scattersAtDispersion) != 0;
    }

    /// The wave that the sample has where its light is dispersed. The indices of glass are for it from the beginning.
    [[nodiscard]] Wave<Real> waveOfSample() const {
        const glm::uvec3 keys = pairKeys(pixel_, scene_.frame.seed, wavelengthPair);
        return sampleWave(unitFloat<Real>(sampleBits(keys, sampleIndex_).x));
    }

    /// The path has light of one wavelength from here on.
    void disperse() {
        if (!isDispersed_)
            weaken(waveOfSample().colour);
        isDispersed_ = true;
    }

    [[nodiscard]] Real mediumIndex(std::uint32_t medium) const {
        if (medium == layout::noMaterial)
            return Real(1);
        if (dispersesLight())
            return indexFor<Real>(scene_.fetchMaterial(medium), waveOfSample().bend);
        return static_cast<Real>(scene_.packed.materials[medium].refractiveIndex);
    }

    [[nodiscard]] bool isDispersive(std::uint32_t medium) const {
        return medium != layout::noMaterial && scene_.packed.materials[medium].dispersion > 0.0f;
    }

    [[nodiscard]] Ray<Real> reflect(const Ray<Real> &ray, const Surface<Real> &surface,
                                    const Vec3<Real> &normal, std::uint32_t primitive) {
        const Vec3<Real> direction = mirrorDirection(ray.direction, normal);
        scatterPdf_ = 0;
        transparency_.endSeeingThrough();
        light_.scatter(Vec3<Real>(Real(0)), false);
        ++counts_.reflection;
        return {offsetRayOrigin(scene_, surface, direction), direction, primitive};
    }

    /// The media on both sides of a glass surface.
    struct Crossing {
        std::uint32_t before; ///< medium counts as in shaders/bsdf/media.glsl
        std::uint32_t beyond;
        Real eta;             ///< refractive index before divided by the one beyond
        bool isNullInterface; ///< the same glass is effective on both sides
        bool isDispersing;    ///< what passes is dispersed
    };

    /// Whether the light is reflected and keeps all its waves: they differ little in how much of them is, unless all of
    /// some is, on the side of the higher index.
    [[nodiscard]] static bool isReflectedWhole(const Crossing &crossing, bool isReflected) {
        return isReflected && crossing.eta < 1;
    }

    [[nodiscard]] Crossing crossingOf(std::uint32_t materialIndex, bool isEntering) const {
        // Glass that is left without having been entered changes nothing: paths begin in what is around the eye.
        const std::uint32_t before = mediaInside_;
        const std::uint32_t beyond =
            isEntering ? enterMedium(before, materialIndex) : leaveMedium(before, materialIndex);
        const std::uint32_t medium = mediumAround(before);
        const std::uint32_t mediumBeyond = mediumAround(beyond);
        const bool disperses = dispersesLight() && (isDispersive(medium) || isDispersive(mediumBeyond));
        return {before, beyond, mediumIndex(medium) / mediumIndex(mediumBeyond), medium == mediumBeyond,
                disperses};
    }

    /// The next ray at smooth glass. It passes straight on if the same glass is effective on both sides; otherwise it
    /// is reflected or refracted, chosen with the probability of the reflectance: isRefracted_.
    [[nodiscard]] Ray<Real> scatterSmoothDielectric(const Ray<Real> &ray, const Surface<Real> &surface,
                                                    std::uint32_t materialIndex, std::uint32_t primitive) {
        isRefracted_ = false;
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
        const bool isReflected = unitFloat<Real>(vertexBits(pairChoice).x) < glass.reflectance;
        if (crossing.isDispersing && !isReflectedWhole(crossing, isReflected))
            disperse();
        if (isReflected) {
            mediaInside_ = crossing.before;
            return reflect(ray, surface, facing, primitive);
        }
        mediaInside_ = crossing.beyond;
        if (carriesRadiance_)
            throughput_ *= eta * eta;
        scatterPdf_ = 0;
        light_.scatter(Vec3<Real>(Real(0)), true);
        ++counts_.refraction;
        isRefracted_ = true;
        return {offsetRayOrigin(scene_, surface, glass.refracted), glass.refracted, primitive};
    }

    /// Whether the material is specular here: a mirror or clear glass. Rough glass with the same index on both sides is
    /// clear, unless it is a mixture, which has other parts and a colour.
    [[nodiscard]] bool isSpecularHere(const MaterialRecord<Real> &material, std::uint32_t materialIndex,
                                      bool isEntering) const {
        if (holdsMedium(scene_, material) && material.alpha > 0) {
            const Crossing crossing = crossingOf(materialIndex, isEntering);
            return crossing.isNullInterface || (!isMixture(scene_, material) && crossing.eta == Real(1));
        }
        return isSpecular(material);
    }

    Counter counter_; ///< before the view, which counts there
    const SceneView<Real> scene_;
    const bool carriesRadiance_;
    glm::uvec2 pixel_{0};
    std::uint32_t sampleIndex_ = 0;
    std::uint32_t depth_ = 0; ///< segment number of the current ray
    Vec3<Real> throughput_{Real(1)};
    Transparency<Real> transparency_;
    LightLayers<Real> light_;
    Real scatterPdf_ = 0;           ///< of the current ray, per solid angle; 0: direction not sampled
    std::uint32_t mediaInside_ = 0; ///< medium counts: see shaders/bsdf/media.glsl
    bool isRefracted_ = false;      ///< at the last smooth glass
    bool isDispersed_ = false;      ///< the light is of one wavelength
    RayCounts counts_;

  private:
    std::vector<layout::TraceEvent> *events_ = nullptr;
};

} // namespace hyalite::core::reference
