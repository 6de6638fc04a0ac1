// The sheen lobe: fibres on cloth, by Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017
// courses, as KHR_materials_sheen has it: Charlie's distribution, and a fitted masking term. Directions are uniform
// over the hemisphere.

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

// The curve a / (1 + b x^c) + d x + e that is fitted to the masking term, by coefficients for roughness 0 and 1.
struct SheenFit {
    float a;
    float b;
    float c;
    float d;
    float e;
};

SheenFit sheenFit(float alpha) {
    float rest = 1.0 - alpha;
    float share = 1.0 - rest * rest;
    return SheenFit(mixture(25.3245, 21.5473, share), mixture(3.32435, 3.82987, share),
                    mixture(0.16801, 0.19823, share), mixture(-1.27393, -1.97760, share),
                    mixture(-4.85967, -4.32054, share));
}

// At a cosine in [0, 1], of which `power` is the power with the exponent c.
float sheenCurve(SheenFit fit, float cosine, float power) {
    float below = 1.0 + fit.b * power;
    return divide(fit.a, below) + fit.d * cosine + fit.e;
}

float sheenCurve(SheenFit fit, float cosine) {
    return sheenCurve(fit, cosine, cosine > 1e-12 ? expNegative(fit.c * negativeLog(cosine)) : 0.0);
}

// Lambda of the masking term, at a cosine in (0, 1].
float sheenLambda(float cosine, float alpha) {
    SheenFit fit = sheenFit(alpha);
    float near = sheenCurve(fit, cosine < 0.5 ? cosine : 1.0 - cosine);
    float middle = 2.0 * sheenCurve(fit, 0.5);
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
