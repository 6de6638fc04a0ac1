// The sheen lobe: fibres on cloth, by Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017
// courses, as KHR_materials_sheen has it: Charlie's distribution, and a fitted masking term. Directions are uniform over
// the hemisphere.

const float pdfHemisphere = 0.15915494309189535; // per solid angle: 1 / (2 pi)

// Alpha of Charlie's distribution. Roughness has a minimum, so that the exponent stays below 205.
float sheenAlphaOf(float roughness) {
    float used = greater(roughness, 0.07);
    return used * used;
}

// Charlie's distribution of normals, per solid angle and per unit of area.
float charlieD(float cosine, float alpha) {
    float squaredSine = 1.0 - cosine * cosine;
    if (!(squaredSine > 1e-12))
        return 0.0;
    float exponent = divide(1.0, alpha);
    float power = expNegative(0.5 * exponent * negativeLog(squaredSine));
    return (2.0 + exponent) * power * (0.5 * inversePi);
}

// The fitted curve of the masking term, at a cosine in [0, 1]; its coefficients are those for roughness 0 and 1.
float sheenCurve(float cosine, float share) {
    float a = mixture(25.3245, 21.5473, share);
    float b = mixture(3.32435, 3.82987, share);
    float c = mixture(0.16801, 0.19823, share);
    float d = mixture(-1.27393, -1.97760, share);
    float e = mixture(-4.85967, -4.32054, share);
    float power = cosine > 1e-12 ? expNegative(c * negativeLog(cosine)) : 0.0;
    float below = 1.0 + b * power;
    return divide(a, below) + d * cosine + e;
}

// Lambda of the masking term, at a cosine in (0, 1].
float sheenLambda(float cosine, float alpha) {
    float rest = 1.0 - alpha;
    float share = 1.0 - rest * rest;
    float near = sheenCurve(cosine < 0.5 ? cosine : 1.0 - cosine, share);
    float middle = 2.0 * sheenCurve(0.5, share);
    return exponential(cosine < 0.5 ? near : middle - near);
}

// The lobe's value at both cosines > 0 to the normal, times that of wi.
float sheenValue(float viewCosine, float lightCosine, float facetCosine, float alpha) {
    float masked = 1.0 + sheenLambda(viewCosine, alpha) + sheenLambda(lightCosine, alpha);
    float below = 4.0 * viewCosine * masked;
    return divide(charlieD(facetCosine, alpha), below);
}

// Directional albedo of white sheen, at this cosine > 0 of the viewer to the normal.
float sheenAlbedo(float cosine, float alpha) {
    EnergyPlace across = energyPlace(squareRoot(cosine), energyCosines);
    EnergyPlace along = energyPlace(squareRoot(alpha), energyRoughnesses);
    uint row = frame.sheenTexels + along.cell * (energyCosines - 1u) + across.cell;
    return cellMixture(fetchLookupRow(row), across.share, along.share);
}

// Sheen alone, chosen with the probability `share`.
Bsdf makeSheen(Bsdf bsdf, vec3 colour, float alpha, float share) {
    bsdf.kind = bsdfSheen;
    bsdf.alpha = alpha;
    bsdf.reflectance = colour;
    bsdf.weight = divide(bsdf.weight, share);
    return bsdf;
}

vec3 sampleHemisphere(vec2 u) {
    float squaredRadius = 1.0 - u.x * u.x;
    float radius = squareRoot(squaredRadius);
    SineCosine angle = sineCosine(u.y);
    return vec3(radius * angle.cosine, radius * angle.sine, u.x);
}

BsdfEval evalSheen(Bsdf bsdf, vec3 wi) {
    vec3 facet = halfVector(bsdf.wo, wi);
    float value = sheenValue(bsdf.wo.z, wi.z, lesser(facet.z, 1.0), bsdf.alpha) * bsdf.weight;
    return BsdfEval(bsdf.reflectance * value, pdfHemisphere);
}
