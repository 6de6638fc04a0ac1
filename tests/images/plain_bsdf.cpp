#include "tests/images/plain_bsdf.h"

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyalite::core::testing::plain {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double coatReflectance = 0.04; // head on: a refractive index of 1.5

double squared(double x) { return x * x; }

/// D G / (4 view.z), the microfacet BRDF times the cosine of the light, except for Fresnel's term: Walter 2007,
/// equation 20.
double reflectedByFacets(const Vec &view, const Vec &light, double alpha) {
    return ggx(glm::normalize(view + light), alpha) * smith(view, light, alpha) / (4.0 * view.z);
}

/// Density of a direction that randomFacet() reflects to: Walter 2007, equations 13 and 14.
double reflectionDensity(const Vec &view, const Vec &light, double alpha) {
    const Vec facet = glm::normalize(view + light);
    return ggx(facet, alpha) * facet.z / (4.0 * glm::dot(view, facet));
}

/// The facet that refracts one to the other: Walter 2007, equation 16.
Vec facetAcross(const Vec &view, const Vec &light, double indexRatio) {
    const Vec facet = glm::normalize(indexRatio * view + light);
    return facet.z < 0.0 ? -facet : facet;
}

/// Snell's law; dielectricFresnel() says where there is no such direction. Walter 2007, equation 40.
Vec refracted(const Vec &view, const Vec &facet, double indexRatio) {
    const double cosine = glm::dot(view, facet);
    const double beyond = std::sqrt(1.0 - squared(indexRatio) * (1.0 - cosine * cosine));
    return (indexRatio * cosine - beyond) * facet - indexRatio * view;
}

Vec cosineDirection(Generator &generator) {
    const double radius = std::sqrt(uniform(generator));
    const double turn = 2.0 * pi * uniform(generator);
    return {radius * std::cos(turn), radius * std::sin(turn),
            std::sqrt(std::max(0.0, 1.0 - radius * radius))};
}

std::optional<Vec> reflectedByRandomFacet(const Vec &view, double alpha, Generator &generator) {
    const Vec facet = randomFacet(alpha, generator);
    const Vec light = 2.0 * glm::dot(view, facet) * facet - view;
    return glm::dot(view, facet) > 0.0 && light.z > 0.0 ? std::optional(light) : std::nullopt;
}

/// (1 - E(view)) (1 - E(light)) / (pi (1 - average E)), times the cosine of the light: Kulla and Conty 2017.
double lost(double ofView, double ofLight, double average, double cosine) {
    return average < 1.0 ? (1.0 - ofView) * (1.0 - ofLight) / (pi * (1.0 - average)) * cosine : 0.0;
}

} // namespace

Bsdf::Bsdf(const Substance &substance, double indexRatio, bool isBehind) {
    const Material &material = *substance.material;
    colour_ = substance.colour;
    roughness_ = substance.roughness;
    indexRatio_ = indexRatio;
    switch (material.kind) {
    case MaterialKind::Conductor:
        metal_ = 1.0;
        isConductor_ = true;
        index_ = material.conductorIndex;
        extinction_ = material.conductorExtinction;
        averageReflectance_ = substance.averageReflectance;
        break;
    case MaterialKind::Dielectric:
        glass_ = 1.0;
        break;
    case MaterialKind::Principled: {
        const bool isInside = isBehind && material.transmission > 0.0f;
        glass_ = isInside ? 1.0 : (1.0 - substance.metallic) * material.transmission;
        metal_ = isInside ? 0.0 : substance.metallic;
        plastic_ = 1.0 - glass_ - metal_;
        averageReflectance_ = colour_ + (1.0 - colour_) / 21.0; // 2 times the integral of (1 - x)^5 x is 1/21
        tint_ = glm::sqrt(colour_);
        const double n = material.refractiveIndex;
        plasticReflectance_ = Vec(std::min(2.0 * material.specular * squared((n - 1.0) / (n + 1.0)), 1.0));
        coat_ = isBehind ? 0.0 : material.clearcoat;
        coatRoughness_ = material.clearcoatRoughness;
        break;
    }
    case MaterialKind::Gltf: {
        isGltf_ = true;
        const double dielectric = 1.0 - substance.metallic;
        const bool isInside = isBehind && material.transmission > 0.0f && !material.isThin;
        thin_ = material.isThin ? dielectric * material.transmission : 0.0;
        glass_ = isInside ? 1.0 : (material.isThin ? 0.0 : dielectric * material.transmission);
        metal_ = isInside ? 0.0 : substance.metallic;
        plastic_ = 1.0 - glass_ - metal_;
        averageReflectance_ = colour_ + (1.0 - colour_) / 21.0;
        tint_ = colour_;
        const double n = material.refractiveIndex;
        const Vec head = squared((n - 1.0) / (n + 1.0)) * Vec(material.dielectricColour);
        plasticReflectance_ = glm::min(head, Vec(1.0)) * double{material.dielectricWeight};
        plasticGrazing_ = material.dielectricWeight;
        diffuselyTransmitted_ =
            double{material.diffuseTransmission} * Vec(material.diffuseTransmissionColour);
        diffuselyReflected_ = 1.0 - material.diffuseTransmission;
        coat_ = isInside ? 0.0 : material.clearcoat;
        coatRoughness_ = material.clearcoatRoughness;
        sheen_ = material.sheenColour;
        sheenRoughness_ = material.sheenRoughness;
        if (material.iridescence > 0.0f && material.iridescenceThickness > 0.0f) {
            const auto film = [&](const Vec &bare, bool isLight) {
                return &thinFilmOf(material.iridescenceIndex, material.iridescenceThickness, bare, isLight);
            };
            filmShare_ = material.iridescence;
            isInside_ = isInside;
            metalFilm_ = metal_ > 0.0 ? film(colour_, false) : nullptr;
            plasticFilm_ = plastic_ > 0.0 ? film(plasticReflectance_, false) : nullptr;
            const double beyond =
                isInside ? indexRatio : 1.0 / indexRatio; // the index of the glass to that outside
            const double ratio = (beyond - 1.0) / (beyond + 1.0);
            glassFilm_ = glass_ > 0.0 ? film(Vec(ratio * ratio), ratio < 0.0) : nullptr;
            if (metalFilm_ != nullptr)
                averageReflectance_ = glm::mix(averageReflectance_, metalFilm_->average(), filmShare_);
        }
        break;
    }
    case MaterialKind::Diffuse:
    case MaterialKind::ShadowCatcher:
    case MaterialKind::Mirror:
        diffuse_ = 1.0;
        break;
    }
    // Any chances are right where each lobe can be drawn; these follow the lobes roughly.
    coatChance_ = coat_ > 0.0 ? 0.2 : 0.0;
    glassChance_ = glass_ * (1.0 - coatChance_);
    const double opaque = (1.0 - glass_) * (1.0 - coatChance_);
    facetChance_ = diffuse_ > 0.0 ? 0.0 : (metal_ > 0.5 ? 0.8 : 0.4) * opaque;
    thinChance_ = thin_ > 0.0 ? 0.3 * opaque : 0.0;
    cosineChance_ = std::max(0.0, 1.0 - coatChance_ - glassChance_ - facetChance_ - thinChance_);
    if (glass_ == 1.0)
        cosineChance_ = 0.0;
    if (plastic_ > 0.0 && diffuselyTransmitted_ != Vec(0.0)) {
        oppositeChance_ = 0.5 * cosineChance_;
        cosineChance_ -= oppositeChance_;
    }
}

Vec Bsdf::evaluateMetal(const Vec &view, const Vec &light) const {
    const double cosine = std::min(glm::dot(view, glm::normalize(view + light)), 1.0);
    Vec fresnel = schlickFresnel(cosine, colour_);
    if (isConductor_)
        for (glm::length_t i = 0; i < 3; ++i)
            fresnel[i] = conductorFresnel(cosine, index_[i], extinction_[i]);
    if (metalFilm_ != nullptr)
        fresnel = glm::mix(fresnel, metalFilm_->at(cosine), filmShare_);
    const double average = averageEnergy(roughness_).white;
    // Kulla and Conty's colour with one more factor F, as what comes back late has met two facets at least: Hill, "A
    // Multi-Faceted Exploration", 2018, part 3.
    const Vec &f = averageReflectance_;
    const Vec late = f * f * average / (1.0 - f * (1.0 - average));
    const double share = lost(directionalEnergy(view.z, roughness_).white,
                              directionalEnergy(light.z, roughness_).white, average, light.z);
    return fresnel * reflectedByFacets(view, light, alphaOf(roughness_)) + late * share;
}

/// The share of the base below a plastic surface that light leaves at this cosine, on either side.
double Bsdf::baseShare(const Vec &view, double lightCosine) const {
    const double r = std::max({plasticReflectance_.x, plasticReflectance_.y, plasticReflectance_.z});
    const double g = plasticGrazing_;
    const double opaque = plastic_ > 0.0 ? 1.0 - thin_ / plastic_ : 1.0;
    return opaque * lost(plasticEnergy(view.z), directionalEnergy(lightCosine, roughness_).of(r, g),
                         averageEnergy(roughness_).of(r, g), lightCosine);
}

Vec Bsdf::evaluatePlastic(const Vec &view, const Vec &light) const {
    const double cosine = std::min(glm::dot(view, glm::normalize(view + light)), 1.0);
    Vec fresnel = schlickFresnel(cosine, plasticReflectance_, plasticGrazing_);
    if (plasticFilm_ != nullptr)
        fresnel = glm::mix(fresnel, plasticFilm_->at(cosine), filmShare_);
    return fresnel * reflectedByFacets(view, light, alphaOf(roughness_)) +
           colour_ * (diffuselyReflected_ * baseShare(view, light.z));
}

/// What facets of plastic keep from what lies below.
double Bsdf::plasticEnergy(double cosine) const {
    const double r = std::max({plasticReflectance_.x, plasticReflectance_.y, plasticReflectance_.z});
    const double bare = directionalEnergy(cosine, roughness_).of(r, plasticGrazing_);
    return plasticFilm_ != nullptr ? glm::mix(bare, plasticFilm_->energy(cosine, roughness_), filmShare_)
                                   : bare;
}

/// A film reflects alike on both sides, if light has the same angle outside.
Vec Bsdf::glassFresnel(double cosine) const {
    const double bare = dielectricFresnel(cosine, indexRatio_);
    if (glassFilm_ == nullptr || bare == 1.0)
        return Vec(bare);
    const double outside =
        isInside_ ? std::sqrt(1.0 - squared(indexRatio_) * (1.0 - cosine * cosine)) : cosine;
    return glm::mix(Vec(bare), glassFilm_->at(outside), filmShare_);
}

double Bsdf::glassLoss(double cosine) const {
    const Vec fresnel = glassFresnel(cosine);
    return std::max({fresnel.x, fresnel.y, fresnel.z});
}

/// Walter 2007, equations 20 and 21. Radiance is larger by the square of the index in glass, so that equation 21 has
/// the index on the side that light goes to: that of the viewer. What facets send to each other comes back in the
/// directions of what they send on at once: Turquin 2019.
Vec Bsdf::evaluateGlass(const Vec &view, const Vec &light) const {
    const double alpha = alphaOf(roughness_);
    const double energy = glassEnergy(view.z, roughness_, indexRatio_);
    if (light.z > 0.0)
        return glassFresnel(std::min(glm::dot(view, glm::normalize(view + light)), 1.0)) *
               (reflectedByFacets(view, light, alpha) / energy);
    const Vec facet = facetAcross(view, light, indexRatio_);
    const double toView = glm::dot(view, facet);
    const double toLight = glm::dot(light, facet);
    if (toView <= 0.0 || toLight >= 0.0)
        return Vec(0.0);
    const double passing = 1.0 - glassLoss(std::min(toView, 1.0));
    return tint_ * (passing / energy * ggx(facet, alpha) * smith(view, light, alpha) * toView * -toLight /
                    view.z * squared(indexRatio_ / (indexRatio_ * toView + toLight)));
}

/// KHR_materials_transmission without volume: what facets reflect, mirrored at the surface. What they send to each
/// other makes up for it: Turquin 2019.
Vec Bsdf::evaluateThin(const Vec &view, const Vec &light) const {
    const Vec mirrored(light.x, light.y, -light.z);
    const double cosine = std::min(glm::dot(view, glm::normalize(view + mirrored)), 1.0);
    const double r = std::max({plasticReflectance_.x, plasticReflectance_.y, plasticReflectance_.z});
    const Energy energy = directionalEnergy(view.z, roughness_);
    const double reflected = plasticEnergy(view.z);
    double kept = schlickFresnel(cosine, Vec(r), plasticGrazing_).x;
    if (plasticFilm_ != nullptr)
        kept = glm::mix(kept, plasticFilm_->loss(cosine), filmShare_);
    return colour_ * ((1.0 - kept) * reflectedByFacets(view, mirrored, alphaOf(roughness_)) *
                      (1.0 - reflected) / (energy.white - reflected));
}

/// What is left for what lies below the coat.
double Bsdf::coatShare(const Vec &view) const {
    if (isGltf_) // KHR_materials_clearcoat, fresnel_coat()
        return 1.0 - coat_ * schlickFresnel(view.z, Vec(coatReflectance)).x;
    return 1.0 - coat_ * directionalEnergy(view.z, coatRoughness_).of(coatReflectance);
}

Vec Bsdf::underSheenAndCoat(const Vec &view, const Vec &light, const Vec &below) const {
    Vec sum = below;
    if (sheen_ != Vec(0.0)) {
        const double strongest = std::max({sheen_.x, sheen_.y, sheen_.z});
        sum *= 1.0 - strongest * sheenEnergy(view.z, sheenRoughness_);
        if (light.z > 0.0)
            sum += sheen_ * sheen(view, light, sheenRoughness_);
    }
    if (coat_ == 0.0)
        return sum;
    sum *= coatShare(view);
    if (light.z < 0.0)
        return sum;
    const double cosine = std::min(glm::dot(view, glm::normalize(view + light)), 1.0);
    return coat_ * schlickFresnel(cosine, Vec(coatReflectance)) *
               reflectedByFacets(view, light, alphaOf(coatRoughness_)) +
           sum;
}

Vec Bsdf::evaluate(const Vec &view, const Vec &light) const {
    if (light.z == 0.0)
        return Vec(0.0);
    Vec sum(0.0);
    if (glass_ > 0.0)
        sum += glass_ * evaluateGlass(view, light);
    if (light.z < 0.0) {
        if (thin_ > 0.0)
            sum += thin_ * evaluateThin(view, light);
        if (oppositeChance_ > 0.0)
            sum += plastic_ * diffuselyTransmitted_ * baseShare(view, -light.z);
        return underSheenAndCoat(view, light, sum);
    }
    if (diffuse_ > 0.0)
        sum += diffuse_ * colour_ * light.z / pi;
    if (metal_ > 0.0)
        sum += metal_ * evaluateMetal(view, light);
    if (plastic_ > 0.0)
        sum += plastic_ * evaluatePlastic(view, light);
    return underSheenAndCoat(view, light, sum);
}

double Bsdf::density(const Vec &view, const Vec &light) const {
    double sum = 0.0;
    if (light.z > 0.0) {
        sum += cosineChance_ * light.z / pi;
        if (facetChance_ > 0.0)
            sum += facetChance_ * reflectionDensity(view, light, alphaOf(roughness_));
        if (coatChance_ > 0.0)
            sum += coatChance_ * reflectionDensity(view, light, alphaOf(coatRoughness_));
        if (glassChance_ > 0.0)
            sum += glassChance_ *
                   dielectricFresnel(glm::dot(view, glm::normalize(view + light)), indexRatio_) *
                   reflectionDensity(view, light, alphaOf(roughness_));
        return sum;
    }
    sum += oppositeChance_ * -light.z / pi;
    if (thinChance_ > 0.0 && light.z < 0.0)
        sum += thinChance_ * reflectionDensity(view, {light.x, light.y, -light.z}, alphaOf(roughness_));
    if (glassChance_ == 0.0 || light.z == 0.0)
        return sum;
    const Vec facet = facetAcross(view, light, indexRatio_);
    const double toView = glm::dot(view, facet);
    const double toLight = glm::dot(light, facet);
    if (toView <= 0.0 || toLight >= 0.0)
        return sum;
    return sum + glassChance_ * (1.0 - dielectricFresnel(toView, indexRatio_)) *
                     ggx(facet, alphaOf(roughness_)) * facet.z * -toLight /
                     squared(indexRatio_ * toView + toLight); // equation 17
}

std::optional<Vec> Bsdf::sample(const Vec &view, Generator &generator) const {
    double choice = uniform(generator);
    if (choice < cosineChance_)
        return cosineDirection(generator);
    choice -= cosineChance_;
    if (choice < oppositeChance_)
        return -cosineDirection(generator);
    choice -= oppositeChance_;
    if (choice < facetChance_)
        return reflectedByRandomFacet(view, alphaOf(roughness_), generator);
    choice -= facetChance_;
    if (choice < coatChance_)
        return reflectedByRandomFacet(view, alphaOf(coatRoughness_), generator);
    choice -= coatChance_;
    if (choice < thinChance_) {
        const std::optional<Vec> light = reflectedByRandomFacet(view, alphaOf(roughness_), generator);
        return light ? std::optional(Vec(light->x, light->y, -light->z)) : std::nullopt;
    }
    const Vec facet = randomFacet(alphaOf(roughness_), generator);
    const double cosine = glm::dot(view, facet);
    if (cosine <= 0.0 || glassChance_ == 0.0)
        return {};
    if (uniform(generator) < dielectricFresnel(cosine, indexRatio_)) {
        const Vec light = 2.0 * cosine * facet - view;
        return light.z > 0.0 ? std::optional(light) : std::nullopt;
    }
    const Vec light = refracted(view, facet, indexRatio_);
    return light.z < 0.0 ? std::optional(light) : std::nullopt;
}

} // namespace hyalite::core::testing::plain
