// The clear coat lobe: GGX facets with a fixed refractive index above a principled material. The layers below are
// scaled by 1 - clearcoat max(E(wo), E(wi)), which is reciprocal and conserves energy (as sheen in glTF's
// KHR_materials_sheen).

const float clearcoatReflectance = 0.04; // at normal incidence: a refractive index of 1.5

// Directional albedo of the coat, at this cosine to the normal.
float clearcoatAlbedo(float cosine, float roughness) {
    return energyAt(energyOf(cosine, roughness), clearcoatReflectance);
}

// The coat alone, chosen with the probability `share`.
Bsdf makeClearcoat(Bsdf bsdf, MaterialRecord material, float share) {
    bsdf.weight = divide(bsdf.clearcoat, share);
    bsdf.alpha = material.clearcoatAlpha;
    bsdf.roughness = bsdf.clearcoatRoughness;
    bsdf.stretchWo = stretchOf(bsdf.wo, bsdf.alpha);
    bsdf.reflectance = vec3(clearcoatReflectance);
    bsdf.clearcoat = 0.0;
    bsdf.specularProbability = 1.0;
    return bsdf;
}

// Fraction of the light to or from `wi` that passes the coat.
float clearcoatTransmittance(Bsdf bsdf, vec3 wi) {
    float energy = clearcoatAlbedo(wi.z, bsdf.clearcoatRoughness);
    return 1.0 - bsdf.clearcoat * greater(energy, bsdf.clearcoatEnergy);
}
