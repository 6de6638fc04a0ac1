// The diffuse lobe: Lambert's albedo / pi, sampled by the cosine.

BsdfEval evalDiffuse(Bsdf bsdf, vec3 wi) {
    float pdf = pdfCosine(wi.z);
    return BsdfEval(bsdf.reflectance * pdf, pdf);
}
