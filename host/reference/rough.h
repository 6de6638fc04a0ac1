// What surfaces with microfacets do with light, and diffuse ones beside them. Twin: shaders/bsdf/rough.glsl.
//
// A principled material is a mixture, after Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 courses: a clear
// coat over a metal, a plastic and a glass. At each hit one of coat, glass, and metal with plastic is chosen with a
// probability that follows its share; emitters and scattered rays then meet that one alone, which is unbiased and never
// mixes densities of what was not chosen.
// The coat leaves to what is below 1 - clearcoat max(E(o), E(i)), which is reciprocal and keeps energy (as sheen in
// glTF's KHR_materials_sheen).
#pragma once

#include "host/reference/conductor.h"
#include "host/reference/dielectric.h"
#include "host/reference/energy.h"
#include "host/reference/microfacet.h"

namespace hyalite::reference {

enum class RoughKind { Diffuse, Opaque, Glass };

template <class Real> struct Rough {
    const std::vector<layout::TexelRecord> &texels;
    Frame<Real> frame; ///< its z is the normal on the side of the viewer
    Vec3<Real> view;   ///< towards the viewer, in the frame
    RoughKind kind = RoughKind::Opaque;
    Real alpha;
    Real roughness;   ///< square root of alpha
    Real stretchView; ///< stretchOf(view, alpha)
    bool isConductor = false;
    Vec3<Real> index; ///< of a conductor
    Vec3<Real> extinction;
    Vec3<Real> reflectance;   ///< of facets of what is no conductor, head on; the albedo of what is diffuse
    Real eta;                 ///< of glass: the refractive index before divided by the one beyond
    Vec3<Real> tint{Real(1)}; ///< of what glass lets pass
    Vec3<Real> late{Real(0)}; ///< what metal reflects later than at once, before (1 - E(i)) cos
    Vec3<Real> body{Real(0)}; ///< what is reflected from below a plastic surface, before (1 - E(i)) cos
    Real plasticReflectance = 0; ///< of that surface, head on
    Real coat = 0;               ///< how much of a coat is above
    Real coatRoughness = 0;
    Real coatEnergy = 0;  ///< what it reflects of the viewer's direction
    Real weight = 1;      ///< 1 / the probability with which it was chosen, of its share
    Real facetChance = 0; ///< that a direction is drawn by facets
};

template <class Real> struct Scattered {
    Vec3<Real> value{Real(0)}; ///< the BSDF times the cosine to the light
    Real density = 0;          ///< of the direction, per solid angle
};

template <class Real>
inline constexpr Real coatReflectance = Real(0.04f);                 ///< head on: a refractive index of 1.5
template <class Real> inline constexpr Real leastLoss = Real(1e-6f); ///< of energy, where it is divided by

template <class Real> [[nodiscard]] Real mean(const Vec3<Real> &colour) {
    return (colour.x + colour.y + colour.z) * Real(1.0 / 3.0);
}

template <class Real> [[nodiscard]] Vec3<Real> toLocal(const Frame<Real> &f, const Vec3<Real> &v) {
    return {dotProduct(f.x, v), dotProduct(f.y, v), dotProduct(f.z, v)};
}

/// (1 - E(o)) / (pi (1 - average E)), the part of a lobe of what is not reflected at once that depends on the viewer.
template <class Real> [[nodiscard]] Real lossShare(Real energy, Real average) {
    const Real averageLoss = greater(Real(1) - average, leastLoss<Real>);
    return inversePi<Real> * ((Real(1) - energy) / averageLoss);
}

template <class Real> [[nodiscard]] Vec3<Real> facetReflectance(const Rough<Real> &rough, Real cosine) {
    if (rough.isConductor)
        return conductorReflectance(lesser(cosine, Real(1)), rough.index, rough.extinction);
    return schlickReflectance(cosine, rough.reflectance);
}

/// The lobes of metal and plastic: `metal` and `plastic` are their shares, the rest is not here.
template <class Real>
[[nodiscard]] Rough<Real> withLobes(Rough<Real> rough, Real metal, Real plastic, const Vec3<Real> &colour,
                                    const Vec3<Real> &metalAverage) {
    const Energy<Real> energy = energyOf(rough.texels, rough.view.z, rough.roughness);
    const Energy<Real> average = averageEnergy(rough.texels, rough.roughness);
    const Vec3<Real> lateColour = lateReflectance(metalAverage, average.white) * metal;
    rough.late = lateColour * lossShare(energy.white, average.white);
    const Real plasticEnergy = energyAt(energy, rough.plasticReflectance);
    const Vec3<Real> bodyColour = colour * plastic;
    rough.body = bodyColour * lossShare(plasticEnergy, energyAt(average, rough.plasticReflectance));
    const Real facets = mean(facetReflectance(rough, rough.view.z)) * energy.white;
    const Real others =
        mean(lateColour) * (Real(1) - energy.white) + mean(bodyColour) * (Real(1) - plasticEnergy);
    rough.facetChance = facets / greater(facets + others, Real(1e-20f));
    return rough;
}

template <class Real>
[[nodiscard]] Rough<Real> principledOf(Rough<Real> rough, const layout::MaterialRecord &material,
                                       bool isBehind, Real choice) {
    const Vec3<Real> colour(material.albedo);
    const Real metallic = static_cast<Real>(material.metallic);
    const Real transmission = static_cast<Real>(material.transmission);
    const Real plasticReflectance = static_cast<Real>(material.normalReflectance);
    Real left = choice;
    if (material.clearcoat > 0.0f && !isBehind) {
        const Real coatAlpha = static_cast<Real>(material.clearcoatAlpha);
        rough.coat = static_cast<Real>(material.clearcoat);
        rough.coatRoughness = std::sqrt(coatAlpha);
        rough.coatEnergy =
            energyAt(energyOf(rough.texels, rough.view.z, rough.coatRoughness), coatReflectance<Real>);
        const Real coatShare = rough.coat * rough.coatEnergy;
        if (left < coatShare) {
            rough.weight = rough.coat / coatShare;
            rough.alpha = coatAlpha;
            rough.roughness = rough.coatRoughness;
            rough.stretchView = stretchOf(rough.view, rough.alpha);
            rough.reflectance = Vec3<Real>(coatReflectance<Real>);
            rough.coat = 0;
            rough.facetChance = 1;
            return rough;
        }
        const Real rest = Real(1) - coatShare;
        left = (left - coatShare) / rest;
        rough.weight = Real(1) / rest;
    }
    const Real dielectric = Real(1) - metallic;
    const Real glass = isBehind && transmission > 0 ? Real(1) : dielectric * transmission;
    if (left < glass) {
        rough.kind = RoughKind::Glass;
        rough.tint = {std::sqrt(colour.x), std::sqrt(colour.y), std::sqrt(colour.z)};
        return rough;
    }
    const Real opaque = Real(1) - glass;
    const Real metal = metallic / opaque;
    const Real plastic = Real(1) - metal;
    rough.plasticReflectance = plasticReflectance;
    rough.reflectance = colour * metal + plasticReflectance * plastic;
    const Vec3<Real> average = colour + (Real(1) - colour) * Real(1.0 / 21.0);
    return withLobes(rough, metal, plastic, colour, average);
}

/// The surface with the unit normals `normal` and `geometricNormal`, on the side of the viewer, where a ray in
/// `direction` ends. `eta` is as in Rough; `choice`, in [0, 1), is random. The energy of microfacets is in `texels`,
/// which must outlive what is returned.
template <class Real>
[[nodiscard]] Rough<Real> roughOf(const std::vector<layout::TexelRecord> &texels,
                                  const layout::MaterialRecord &material, const Vec3<Real> &direction,
                                  const Vec3<Real> &normal, const Vec3<Real> &geometricNormal, bool isBehind,
                                  Real eta, Real choice) {
    const Frame<Real> frame = frameAround(dotProduct(direction, normal) < 0 ? normal : geometricNormal);
    const Vec3<Real> view = toLocal(frame, -direction);
    const Real alpha = static_cast<Real>(material.alpha);
    Rough<Real> rough{.texels = texels,
                      .frame = frame,
                      .view = view,
                      .alpha = alpha,
                      .roughness = std::sqrt(alpha),
                      .stretchView = stretchOf(view, alpha),
                      .index = Vec3<Real>(material.conductorIndex),
                      .extinction = Vec3<Real>(material.conductorExtinction),
                      .reflectance = Vec3<Real>(material.albedo),
                      .eta = eta};
    if (kindOf(material) == layout::materialPrincipled)
        return principledOf(rough, material, isBehind, choice);
    if (kindOf(material) == layout::materialConductor) {
        rough.isConductor = true;
        return withLobes(rough, Real(1), Real(0), Vec3<Real>(Real(0)),
                         Vec3<Real>(material.averageReflectance));
    }
    rough.kind = kindOf(material) == layout::materialDielectric ? RoughKind::Glass : RoughKind::Diffuse;
    return rough;
}

/// A direction in the frame, or 0 where a facet sends light to the wrong side; `choice`, in [0, 1), is another random
/// number.
template <class Real>
[[nodiscard]] Vec3<Real> drawRough(const Rough<Real> &rough, const Vec2<Real> &u, Real choice) {
    if (rough.kind == RoughKind::Diffuse ||
        (rough.kind == RoughKind::Opaque && choice >= rough.facetChance)) {
        const Real radius = std::sqrt(u.x);
        const SineCosine<Real> angle = sineCosine(u.y);
        return {radius * angle.cosine, radius * angle.sine, std::sqrt(Real(1) - u.x)};
    }
    const Vec3<Real> facet = sampleVisibleFacet(rough.view, rough.alpha, u);
    if (rough.kind == RoughKind::Glass) {
        const Interface<Real> glass = meetInterface(-rough.view, facet, rough.eta);
        if (choice >= glass.reflectance)
            return glass.refracted.z < 0 ? glass.refracted : Vec3<Real>(Real(0));
    }
    const Vec3<Real> reflected = unitVector(mirrorDirection(-rough.view, facet));
    return reflected.z > 0 ? reflected : Vec3<Real>(Real(0));
}

/// Light that passes rough glass to or from `light`, below the surface.
template <class Real>
[[nodiscard]] Scattered<Real> passGlass(const Rough<Real> &rough, const Vec3<Real> &light) {
    const Vec3<Real> facet = facetAcross(rough.view, light, rough.eta);
    const Real viewCosine = dotProduct(rough.view, facet);
    const Real lightCosine = dotProduct(light, facet);
    if (viewCosine <= 0 || lightCosine >= 0)
        return {};
    const Interface<Real> glass = meetInterface(-rough.view, facet, rough.eta);
    const Real facets = facetDensity(facet, rough.alpha);
    const Real passing =
        (Real(1) - glass.reflectance) *
        refractionDensity(facets, rough.view, rough.stretchView, viewCosine, lightCosine, rough.eta);
    const Real lit = litShare(rough.view.z, rough.stretchView, light.z, stretchOf(light, rough.alpha));
    const Real value = passing * lit * (rough.eta * rough.eta) * rough.weight;
    return {rough.tint * value, passing};
}

/// What the surface does with light from `light`, a unit vector in the frame.
template <class Real>
[[nodiscard]] Scattered<Real> evaluateRough(const Rough<Real> &rough, const Vec3<Real> &light) {
    if (rough.kind == RoughKind::Glass && light.z < 0)
        return passGlass(rough, light);
    if (light.z <= 0)
        return {};
    const Real cosineDensity = pdfCosine(light.z);
    if (rough.kind == RoughKind::Diffuse)
        return {rough.reflectance * cosineDensity, cosineDensity};
    const Vec3<Real> facet = facetBetween(rough.view, light);
    const Real cosine = dotProduct(rough.view, facet);
    const Real reflected = reflectionDensity(facetDensity(facet, rough.alpha), rough.view, rough.stretchView);
    const Real lit = litShare(rough.view.z, rough.stretchView, light.z, stretchOf(light, rough.alpha));
    if (rough.kind == RoughKind::Glass) {
        const Real share = reflected * meetInterface(-rough.view, facet, rough.eta).reflectance;
        return {Vec3<Real>(share * lit * rough.weight), share};
    }
    const Real atOnce = reflected * lit;
    Vec3<Real> value = facetReflectance(rough, cosine) * atOnce;
    const Real density = rough.facetChance * reflected + (Real(1) - rough.facetChance) * cosineDensity;
    if (rough.facetChance < 1) {
        const Energy<Real> energy = energyOf(rough.texels, light.z, rough.roughness);
        const Real lateShare = (Real(1) - energy.white) * light.z;
        const Real bodyShare = (Real(1) - energyAt(energy, rough.plasticReflectance)) * light.z;
        value = value + rough.late * lateShare + rough.body * bodyShare;
    }
    Real below = rough.weight;
    if (rough.coat > 0) {
        const Real energy =
            energyAt(energyOf(rough.texels, light.z, rough.coatRoughness), coatReflectance<Real>);
        below = below * (Real(1) - rough.coat * greater(energy, rough.coatEnergy));
    }
    return {value * below, density};
}

} // namespace hyalite::reference
