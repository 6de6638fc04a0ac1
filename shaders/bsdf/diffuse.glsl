// The diffuse lobe: Lambert's albedo / pi, sampled by the cosine.

BsdfEval evalDiffuse(Bsdf bsdf, vec3 wi) {
    float pdf = pdfCosine(wi.z);
    return BsdfEval(bsdf.reflectance * pdf, pdf);
}

// In the frame: a point of the unit disc, projected up (Malley).
vec3 sampleDiffuse(vec2 u) {
    float radius = squareRoot(u.x);
    SineCosine angle = sineCosine(u.y);
    float below = 1.0 - u.x;
    return vec3(radius * angle.cosine, radius * angle.sine, squareRoot(below));
}
