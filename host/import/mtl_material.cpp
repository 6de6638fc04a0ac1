#include "host/import/mtl_material.h"

#include <algorithm>
#include <cmath>

namespace hyalite::core {

namespace {

float mean(const glm::vec3 &colour) { return (colour.x + colour.y + colour.z) / 3.0f; }

/// The roughness whose microfacets spread like those of this Blinn-Phong exponent: Walter et al., "Microfacet Models
/// for Refraction through Rough Surfaces", EGSR 2007, section 5.2.
float roughnessOf(float exponent) { return std::sqrt(std::sqrt(2.0f / (std::max(exponent, 0.0f) + 2.0f))); }

} // namespace

float opacityOf(const MtlStatements &mtl) {
    if (mtl.dissolve)
        return *mtl.dissolve;
    return mtl.transparency.value_or(1.0f) == 1.0f ? 1.0f : 1.0f - *mtl.transparency;
}

Material materialOf(const MtlStatements &mtl) {
    Material material;
    material.name = mtl.name;
    material.twoSided = true;
    const auto has = [&](std::uint32_t slot) { return mtl.textures[slot].has_value(); };
    const int illum = mtl.illumination;
    const bool isPhysical =
        mtl.roughness || mtl.metallic || has(layout::slotRoughness) || has(layout::slotMetallic);
    const glm::vec3 black(0.0f);
    const bool hasLook = isPhysical || !mtl.colourName.empty() || mtl.diffuse.value_or(black) != black;
    const bool isMetal = (illum == 3 || illum == 5) && !hasLook && mtl.specular != black;
    const bool isRefracting = illum == 4 || illum == 6 || illum == 7 || illum == 9;
    if (isRefracting && !hasLook && mtl.dissolve.value_or(0.0f) < 1.0f &&
        mtl.index.value_or(mtl.diffuse ? 1.0f : 1.5f) > 1.0f) {
        material.kind = MaterialKind::Dielectric;
        material.refractiveIndex = mtl.index.value_or(1.5f);
        return material;
    }
    // Beside a texture, black stands for no factor.
    const bool hasFactor = mtl.diffuse && (mtl.colourName.empty() || *mtl.diffuse != black);
    const glm::vec3 diffuse = hasFactor ? *mtl.diffuse : glm::vec3(has(layout::slotBaseColour) ? 1.0f : 0.8f);
    material.albedo = isMetal ? mtl.specular : diffuse;
    material.emission = has(layout::slotEmission) && mtl.emission == black ? glm::vec3(1.0f) : mtl.emission;
    material.textures = mtl.textures;
    material.normalStrength = mtl.normalStrength;
    const float opacity = opacityOf(mtl);
    if (!isMetal && !isPhysical && mtl.specular == black && opacity == 1.0f && mtl.clearcoat == 0.0f)
        return material; // matt
    material.kind = MaterialKind::Principled;
    material.refractiveIndex = mtl.index.value_or(1.5f);
    material.roughness = has(layout::slotRoughness) ? 1.0f
                         : mtl.roughness            ? *mtl.roughness
                                                    : roughnessOf(mtl.exponent.value_or(0.0f));
    material.metallic = isMetal || has(layout::slotMetallic) ? 1.0f : mtl.metallic.value_or(0.0f);
    material.specular = isPhysical ? 0.5f : mean(mtl.specular);
    material.transmission = 1.0f - opacity;
    if (opacity == 1.0f) { // what transmits has no coat
        material.clearcoat = mtl.clearcoat;
        material.clearcoatRoughness = mtl.clearcoatRoughness.value_or(material.clearcoatRoughness);
    }
    return material;
}

} // namespace hyalite::core
