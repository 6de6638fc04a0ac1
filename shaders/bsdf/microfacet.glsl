// GGX microfacets: distribution, masking and shadowing, sampling of visible normals, half vectors.
//
// All directions are unit vectors in the frame of the surface, whose normal is +z; `wo` has z > 0 and leads back along
// the path. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; Heitz, "Understanding
// the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014, for the masking of both directions
// together: G = 2 |o.z| |i.z| / (|o.z| stretch(i) + |i.z| stretch(o)).

// Length of `w` after the surface is stretched to alpha 1.
float stretchOf(vec3 w, float alpha) {
    float squaredAlpha = alpha * alpha;
    float squaredSine = w.x * w.x + w.y * w.y;
    float squared = squaredAlpha * squaredSine + w.z * w.z;
    return squareRoot(squared);
}

// The distribution of normals D(m), per solid angle and per unit of area.
float ggxD(vec3 m, float alpha) {
    float squaredAlpha = alpha * alpha;
    float squaredSine = m.x * m.x + m.y * m.y;
    float spread = squaredSine + squaredAlpha * (m.z * m.z);
    float squared = spread * spread;
    float scaled = squaredAlpha * inversePi;
    return divide(scaled, squared);
}

// The visible normal at a point of the spherical cap: at this azimuth, with the share `above` of the cap above it.
// Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
vec3 visibleGgxNormal(vec3 wo, vec2 alphas, SineCosine azimuth, float above) {
    vec3 stretched = unitVector(vec3(vec2(wo) * alphas, wo.z));
    float z = (1.0 - above) * (1.0 + stretched.z) - stretched.z;
    float squaredSine = 1.0 - z * z;
    float sine = squareRoot(greater(squaredSine, 0.0));
    vec3 cap = vec3(sine * azimuth.cosine, sine * azimuth.sine, z) + stretched;
    return unitVector(vec3(vec2(cap) * alphas, cap.z));
}

// Samples a visible normal, with the pdf ggxD G1 (wo.m) / wo.z.
vec3 sampleGgxVndf(vec3 wo, vec2 alphas, vec2 u) { return visibleGgxNormal(wo, alphas, sineCosine(u.x), u.y); }

vec3 sampleGgxVndf(vec3 wo, float alpha, vec2 u) { return sampleGgxVndf(wo, vec2(alpha), u); }

// The same for facets that are stretched along x and y by different alphas.
float stretchOf(vec3 w, vec2 alphas) {
    float x = w.x * alphas.x;
    float y = w.y * alphas.y;
    float squared = x * x + y * y + w.z * w.z;
    return squareRoot(squared);
}

// Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 courses, section B.2.
float ggxD(vec3 m, vec2 alphas) {
    float product = alphas.x * alphas.y;
    float x = m.x * alphas.y;
    float y = m.y * alphas.x;
    float z = m.z * product;
    float spread = x * x + y * y + z * z;
    float squared = spread * spread;
    float scaled = product * product * product * inversePi;
    return divide(scaled, squared);
}

// The pdf, per solid angle, of the direction to which a visible facet reflects `wo`. `pdf` is ggxD of the facet.
float pdfReflection(float pdf, vec3 wo, float stretchWo) {
    float below = 2.0 * (wo.z + stretchWo);
    return divide(pdf, below);
}

// Fraction of the visible facets that are also lit: G / G1(wo). `wi` may be on the other side.
float smithG2OverG1(float viewHeight, float stretchWo, float lightHeight, float stretchLight) {
    float height = abs(lightHeight);
    float above = height * (viewHeight + stretchWo);
    float below = viewHeight * stretchLight + height * stretchWo;
    return divide(above, below);
}

// The half vector: the facet that reflects `wo` to `wi`.
vec3 halfVector(vec3 wo, vec3 wi) { return unitVector(wo + wi); }

// The half vector of refraction: the facet that refracts `wo` to `wi` on the other side; z > 0 if there is one. `eta`
// is the refractive index on the side of `wo` divided by that on the other side.
vec3 halfVectorOfRefraction(vec3 wo, vec3 wi, float eta) {
    vec3 across = wo * eta + wi;
    vec3 m = unitVector(across);
    return m.z < 0.0 ? -m : m;
}

// The pdf, per solid angle, of the direction to which visible facets refract: the pdf of the visible facet times
// Walter's Jacobian (equation 17). `pdf` is ggxD of the facet. `viewCosine` > 0 and `lightCosine` < 0 are the cosines
// of both directions to the facet.
float pdfRefraction(float pdf, vec3 wo, float stretchWo, float viewCosine, float lightCosine, float eta) {
    float seen = pdf * 2.0 * viewCosine * -lightCosine;
    float sum = eta * viewCosine + lightCosine;
    float below = (wo.z + stretchWo) * (sum * sum);
    return divide(seen, below);
}
