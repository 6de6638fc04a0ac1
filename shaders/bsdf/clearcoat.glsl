// The clear coat: GGX facets of a fixed refractive index above a principled material. It leaves to what is below
// 1 - clearcoat max(E(wo), E(wi)), which is reciprocal and keeps energy (as sheen in glTF's KHR_materials_sheen).

const float clearcoatReflectance = 0.04; // head on: a refractive index of 1.5

// What the coat reflects of a direction with this cosine to the normal.
float clearcoatAlbedo(float cosine, float roughness) {
    return energyAt(energyOf(cosine, roughness), clearcoatReflectance);
}

// The coat alone, with the probability `share` of being chosen.
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

// The share of light to or from `wi` that the coat lets pass.
float clearcoatTransmittance(Bsdf bsdf, vec3 wi) {
    float energy = clearcoatAlbedo(wi.z, bsdf.clearcoatRoughness);
    return 1.0 - bsdf.clearcoat * greater(energy, bsdf.clearcoatEnergy);
}
