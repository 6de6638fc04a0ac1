// The clear coat lobe: GGX facets with a fixed refractive index above a principled material. What lies below gets what
// the coat does not reflect of the viewer's direction, 1 - clearcoat E(wo). All energy is kept: light that the coat
// keeps from leaving is reflected back to what lies below, and comes out in the end.

const float clearcoatReflectance = 0.04; // at normal incidence: a refractive index of 1.5

// Directional albedo of the coat, at this cosine to the normal.
float clearcoatAlbedo(float cosine, float roughness) {
    return energyAt(energyOf(cosine, roughness), clearcoatReflectance, 1.0);
}

// The coat alone, chosen with the probability `share`.
Bsdf makeClearcoat(Bsdf bsdf, MaterialRecord material, float share) {
    bsdf.weight = divide(material.clearcoat, share);
    bsdf.alpha = material.clearcoatAlpha;
    bsdf.alphas = vec2(material.clearcoatAlpha);
    bsdf.roughness = squareRoot(material.clearcoatAlpha);
    bsdf.stretchWo = stretchOf(bsdf.wo, bsdf.alpha);
    bsdf.reflectance = vec3(clearcoatReflectance);
    bsdf.specularProbability = 1.0;
    return bsdf;
}
