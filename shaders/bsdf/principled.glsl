// The principled material: a clear coat over a mixture of metal, plastic and glass, after Burley, "Physically Based
// Shading at Disney", SIGGRAPH 2012 courses.
//
// At each hit one component is chosen with a probability that follows its share: the coat, glass, or metal with
// plastic. Light samples and scattered rays then see only that component, which is unbiased, and its pdf is never mixed
// with those of others.

// The tint of light that passes a surface of the glass: what goes in and out has the base colour.
vec3 principledTint(MaterialRecord material) {
    return vec3(squareRoot(material.albedo.x), squareRoot(material.albedo.y), squareRoot(material.albedo.z));
}

Bsdf makePrincipled(Bsdf bsdf, MaterialRecord material, bool isBehind, float choice) {
    float left = choice;
    if (material.clearcoat > 0.0 && !isBehind) {
        float energy = clearcoatAlbedo(bsdf.wo.z, squareRoot(material.clearcoatAlpha));
        float clearcoatShare = material.clearcoat * energy;
        if (left < clearcoatShare)
            return makeClearcoat(bsdf, material, clearcoatShare);
        // The weight of what lies below, 1 - clearcoatShare, is also the probability of choosing it.
        left = choiceBeyond(left, clearcoatShare);
    }
    float dielectric = 1.0 - material.metallic;
    float glass = isBehind && material.transmission > 0.0 ? 1.0 : dielectric * material.transmission;
    if ((scattering & scattersAtRoughGlass) != 0u && left < glass) {
        bsdf.tint = principledTint(material);
        return makeGlass(bsdf);
    }
    float opaque = 1.0 - glass;
    float metal = divide(material.metallic, opaque);
    float plastic = 1.0 - metal;
    bsdf.plasticReflectance = material.normalReflectance;
    bsdf.reflectance = material.albedo * metal + material.normalReflectance * plastic;
    vec3 average = material.albedo + (1.0 - material.albedo) * (1.0 / 21.0);
    return addOpaqueLobes(bsdf, metal, plastic, material.albedo, vec3(0.0), average);
}
