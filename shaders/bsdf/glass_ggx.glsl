// The lobe of rough glass: GGX facets that reflect and refract. Walter et al., "Microfacet Models for Refraction
// through Rough Surfaces", EGSR 2007, equations 20 and 21; divided by what they scatter at once (Turquin 2019, see
// energy.glsl).

// Makes `bsdf`, whose eta is not 1, glass.
Bsdf makeGlass(Bsdf bsdf) {
    bsdf.kind = bsdfGlass;
    bsdf.weight = divide(bsdf.weight, glassEnergy(bsdf.wo.z, bsdf.roughness, bsdf.eta));
    return bsdf;
}

// Transmission, for `wi` below the surface.
BsdfEval evalGlassTransmission(Bsdf bsdf, vec3 wi) {
    vec3 facet = halfVectorOfRefraction(bsdf.wo, wi, bsdf.eta);
    float viewCosine = dotProduct(bsdf.wo, facet);
    float lightCosine = dotProduct(wi, facet);
    if (viewCosine <= 0.0 || lightCosine >= 0.0)
        return BsdfEval(vec3(0.0), 0.0);
    DielectricFresnel glass = fresnelDielectric(-bsdf.wo, facet, bsdf.eta);
    float facets = ggxD(facet, bsdf.alpha);
    float passed = (1.0 - glass.reflectance) *
                            pdfRefraction(facets, bsdf.wo, bsdf.stretchWo, viewCosine, lightCosine, bsdf.eta);
    float lit = smithG2OverG1(bsdf.wo.z, bsdf.stretchWo, wi.z, stretchOf(wi, bsdf.alpha));
    float value = passed * lit * (bsdf.eta * bsdf.eta) * bsdf.weight;
    return BsdfEval(bsdf.tint * value, passed);
}

// Reflection, for `wi` above the surface.
BsdfEval evalGlassReflection(Bsdf bsdf, vec3 wi) {
    vec3 facet = halfVector(bsdf.wo, wi);
    float reflected = pdfReflection(ggxD(facet, bsdf.alpha), bsdf.wo, bsdf.stretchWo);
    float lit = smithG2OverG1(bsdf.wo.z, bsdf.stretchWo, wi.z, stretchOf(wi, bsdf.alpha));
    float share = reflected * fresnelDielectric(-bsdf.wo, facet, bsdf.eta).reflectance;
    float value = share * lit * bsdf.weight;
    return BsdfEval(vec3(value), share);
}

BsdfEval evalGlass(Bsdf bsdf, vec3 wi) {
    if (wi.z < 0.0)
        return evalGlassTransmission(bsdf, wi);
    return evalGlassReflection(bsdf, wi);
}
