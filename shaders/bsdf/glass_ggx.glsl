// The lobe of rough glass: GGX facets that reflect and refract. Walter et al., "Microfacet Models for Refraction
// through Rough Surfaces", EGSR 2007, equations 20 and 21; divided by what they scatter at once (Turquin 2019, see
// energy.glsl).

// Makes `bsdf`, whose eta is not 1, glass.
Bsdf makeGlass(Bsdf bsdf) {
    bsdf.kind = bsdfGlass;
    bsdf.weight = divide(bsdf.weight, glassEnergy(bsdf.wo.z, bsdf.roughness, bsdf.eta));
    return bsdf;
}

// Reflectance of `facet`, with the film on it if there is one. It is reflected with the probability of its strongest
// channel, and only what that leaves passes.
vec3 glassReflectance(Bsdf bsdf, DielectricFresnel glass, vec3 facet) {
    vec3 bare = vec3(glass.reflectance);
    if (!hasFilm(bsdf) || glass.reflectance >= 1.0)
        return bare;
    // Light goes both ways through a film alike: what counts is the angle outside.
    float cosine = bsdf.iridescence.isBelow ? -dotProduct(glass.refracted, facet) : dotProduct(bsdf.wo, facet);
    vec3 covered = iridescentReflectance(bsdf.iridescence, bsdf.iridescence.dielectricAmplitude, cosine);
    return mixtureOf(bare, covered, bsdf.iridescence.share);
}

// `wi` may be on either side.
BsdfEval evalGlass(Bsdf bsdf, vec3 wi) {
    bool isRefracted = wi.z < 0.0;
    vec3 facet = isRefracted ? halfVectorOfRefraction(bsdf.wo, wi, bsdf.eta) : halfVector(bsdf.wo, wi);
    float viewCosine = dotProduct(bsdf.wo, facet);
    float lightCosine = dotProduct(wi, facet);
    if (isRefracted && (viewCosine <= 0.0 || lightCosine >= 0.0))
        return BsdfEval(vec3(0.0), 0.0);
    vec3 reflectance = glassReflectance(bsdf, fresnelDielectric(-bsdf.wo, facet, bsdf.eta), facet);
    float facets = ggxD(facet, bsdf.alpha);
    float lit = smithG2OverG1(bsdf.wo.z, bsdf.stretchWo, wi.z, stretchOf(wi, bsdf.alpha));
    if (isRefracted) {
        float passed = (1.0 - largestComponent(reflectance)) *
                       pdfRefraction(facets, bsdf.wo, bsdf.stretchWo, viewCosine, lightCosine, bsdf.eta);
        float value = passed * lit * (bsdf.eta * bsdf.eta) * bsdf.weight;
        return BsdfEval(bsdf.tint * value, passed);
    }
    float reflected = pdfReflection(facets, bsdf.wo, bsdf.stretchWo);
    vec3 value = reflectance * reflected * lit * bsdf.weight;
    return BsdfEval(value, reflected * largestComponent(reflectance));
}
