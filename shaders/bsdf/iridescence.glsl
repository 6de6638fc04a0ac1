// Iridescence: a film about as thin as light's waves are long lies on metal, plastic or glass, and what its two sides
// reflect interferes. KHR_materials_iridescence, after Belcour and Barla, "A Practical Extension to Microfacet Theory
// for the Modeling of Varying Iridescence", SIGGRAPH 2017. What differs from the extension is in README.md.

struct Iridescence {
    float share;     // of the surface that has the film; 0: there is none
    float index;     // refractive index of the film, at least 1
    float thickness; // in nanometres
    float metal;     // share of metal in what lies below
    vec3 metalAmplitude;      // of the reflection between film and metal, at normal incidence
    vec3 dielectricAmplitude; // and between film and plastic or glass
    bool isBelow;             // it is seen from within the glass
};

Iridescence noIridescence() {
    return Iridescence(0.0, 1.0, 0.0, 0.0, vec3(0.0), vec3(0.0), false);
}

// Whether a material of glTF has a film.
bool isIridescent(MaterialRecord material) {
    return (scattering & scattersAtIridescent) != 0u && material.iridescence > 0.0 &&
           material.iridescenceThickness > 0.0;
}

// Amplitude of the reflection between air and the film at normal incidence.
float filmAmplitude(float index) {
    float below = index + 1.0;
    return divide(index - 1.0, below);
}

// Amplitude of the reflection between the film and what lies below, which reflects the amplitude `bare` in [-1, 1]
// between air and itself: (n3 - n2) / (n3 + n2) by those of n3 and n2 to air. Light's phase is turned where it is > 0.
float amplitudeBelow(float bare, float film) {
    float below = 1.0 - bare * film;
    return divide(bare - film, below);
}

vec3 amplitudesBelow(vec3 reflectance, float film) {
    return vec3(amplitudeBelow(squareRoot(lesser(reflectance.x, 1.0)), film),
                amplitudeBelow(squareRoot(lesser(reflectance.y, 1.0)), film),
                amplitudeBelow(squareRoot(lesser(reflectance.z, 1.0)), film));
}

// The film of a material on metal and plastic, of which `metal` is metal. `dielectric` is the reflectance of plastic at
// normal incidence.
Iridescence filmOnOpaque(MaterialRecord material, float metal, vec3 dielectric) {
    float film = filmAmplitude(material.iridescenceIndex);
    return Iridescence(material.iridescence, material.iridescenceIndex, material.iridescenceThickness, metal,
                       amplitudesBelow(material.albedo, film), amplitudesBelow(dielectric, film), false);
}

// On glass; `eta` is as in Bsdf. isBelow: seen from within.
Iridescence filmOnGlass(MaterialRecord material, float eta, bool isBelow) {
    float film = filmAmplitude(material.iridescenceIndex);
    float difference = isBelow ? eta - 1.0 : 1.0 - eta;
    float sum = eta + 1.0;
    vec3 amplitude = vec3(amplitudeBelow(divide(difference, sum), film));
    return Iridescence(material.iridescence, material.iridescenceIndex, material.iridescenceThickness, 0.0, amplitude,
                       amplitude, isBelow);
}

// The cosine of an angle of 0 or more turns.
float waveCosine(float turns) { return sineCosine(turns - floor(turns)).cosine; }

// The colour of interference, relative to white: of its waves, which the four lobes of the matching functions weigh,
// two of x, then y and z. The lobes are Gaussians over 1 / wavelength: Belcour and Barla 2017, section 4.3, with the
// numbers of their code. Then from XYZ to the primaries of Rec. 709, each channel divided by that of white, so that a
// reflectance that is the same for all waves has no colour.
vec3 colourOfWaves(vec4 waves) {
    float red = 2.2759310 * waves.x + 0.4136520 * waves.y - 1.2755263 * waves.z - 0.4140567 * waves.w;
    float green = -0.8652895 * waves.x - 0.1572670 * waves.y + 1.9786866 * waves.z + 0.0438699 * waves.w;
    float blue = 0.0517655 * waves.x + 0.0094084 * waves.y - 0.2242517 * waves.z + 1.1630778 * waves.w;
    return vec3(red, green, blue);
}

const int interferenceOrders = 6; // what is left out is below 0.01 but at grazing angles of dense films

// Reflectance of the film and of what lies below together, at this cosine of the angle of incidence outside.
// Reflections within the film are a series, whose terms are integrated over the spectrum one by one: Belcour and Barla
// 2017, equations 9 and 10. Fresnel's terms are Schlick's, without polarisation, as the extension has them.
vec3 iridescentReflectance(Iridescence film, vec3 amplitude, float cosine) {
    float outside = greater(lesser(cosine, 1.0), 0.0);
    float inverse = divide(1.0, film.index);
    float squaredSine = (1.0 - outside * outside) * (inverse * inverse);
    float inside = squareRoot(greater(1.0 - squaredSine, 0.0));
    float normal = filmAmplitude(film.index);
    float upper = schlickReflectance(outside, vec3(normal * normal), 1.0).x;
    vec3 lower = schlickReflectance(inside, amplitude * amplitude, 1.0);
    float passed = 1.0 - upper;
    vec3 both = withoutTiny(lower * upper);
    vec3 late = lower * (passed * passed) * divide(1.0, greater(1.0 - both, vec3(1e-6)));
    vec3 bounce = vec3(squareRoot(both.x), squareRoot(both.y), squareRoot(both.z));
    bounce = vec3(amplitude.x > 0.0 ? -bounce.x : bounce.x, amplitude.y > 0.0 ? -bounce.y : bounce.y,
                  amplitude.z > 0.0 ? -bounce.z : bounce.z);

    // Light that goes down and up once more is this much behind, in nanometres.
    float behind = 2.0 * film.index * film.thickness * inside;
    float squared = behind * behind;
    vec4 first = vec4(waveCosine(behind * 0.0016810), waveCosine(behind * 0.0022399), waveCosine(behind * 0.0017953),
                      waveCosine(behind * 0.0022084));
    vec4 fading = vec4(expNegative(squared * 1.7085470e-7), expNegative(squared * 1.7876617e-7),
                       expNegative(squared * 3.6733088e-7), expNegative(squared * 2.6103525e-7));
    vec4 squaredFading = fading * fading;
    vec4 fadingStep = squaredFading * fading;
    vec4 before = vec4(1.0);
    vec4 wave = first;
    vec3 strength = 2.0 * (late - passed);
    vec3 sum = upper + late;
    for (int order = 0; order < interferenceOrders; ++order) {
        strength = strength * bounce;
        sum = sum + strength * colourOfWaves(wave * fading);
        vec4 next = 2.0 * first * wave - before; // cosines of multiples of an angle
        before = wave;
        wave = next;
        fading = fading * fadingStep; // e to the minus the order squared
        fadingStep = fadingStep * squaredFading;
    }
    return lesser(greater(sum, vec3(0.0)), vec3(1.0));
}

// Of metal and plastic, as they are mixed below. In a loop, as inlined twice it would be much of the kernel.
vec3 iridescentReflectance(Iridescence film, float cosine) {
    vec3 reflectance = vec3(0.0);
    for (int i = 0; i < 2; ++i) {
        float share = i == 0 ? film.metal : 1.0 - film.metal;
        if (share > 0.0) {
            vec3 amplitude = i == 0 ? film.metalAmplitude : film.dielectricAmplitude;
            reflectance = reflectance + iridescentReflectance(film, amplitude, cosine) * share;
        }
    }
    return reflectance;
}

// What the film keeps from plastic: the strongest channel of its reflectance, so that what comes back from below has
// not the opposite colour.
float iridescentLoss(Iridescence film, float cosine) {
    return largestComponent(iridescentReflectance(film, film.dielectricAmplitude, cosine));
}

// The cosine-weighted average over the hemisphere of the film's reflectance on metal: by Gauss and Jacobi at two
// cosines.
vec3 averageIridescence(Iridescence film) {
    vec3 average = vec3(0.0);
    for (int i = 0; i < 2; ++i) {
        float cosine = i == 0 ? 0.35505103 : 0.84494897;
        float weight = i == 0 ? 0.36391724 : 0.63608276;
        average = average + iridescentReflectance(film, film.metalAmplitude, cosine) * weight;
    }
    return average;
}

// Node of Gauss's quadrature over [0, 1] with four points, and its weight.
vec2 gaussNode(uint i) {
    float node = i == 1u || i == 2u ? 0.33000948 : 0.06943184;
    float weight = i == 1u || i == 2u ? 0.32607258 : 0.17392742;
    float mirrored = 1.0 - node;
    return vec2(i < 2u ? node : mirrored, weight);
}

// Directional albedo of facets that lose to the film what iridescentLoss() says, seen at this cosine > 0 to the normal.
// `energy` is that of the cosine. By quadrature over visible facets of what differs from Schlick's curve from `normal`.
float iridescentEnergy(Iridescence film, Energy energy, float cosine, float roughness, float normal) {
    float squaredSine = 1.0 - cosine * cosine;
    vec3 wo = vec3(squareRoot(greater(squaredSine, 0.0)), 0.0, cosine);
    float alpha = roughness * roughness;
    float stretchWo = stretchOf(wo, alpha);
    float sum = 0.0;
    float lit = 0.0;
    for (uint i = 0u; i < 8u; ++i) {
        vec2 node = gaussNode(i & 3u);
        SineCosine azimuth = SineCosine(0.70710678, i < 4u ? 0.70710678 : -0.70710678);
        vec3 facet = visibleGgxNormal(wo, vec2(alpha), azimuth, node.x);
        vec3 wi = mirrorDirection(-wo, facet);
        if (wi.z > 0.0) {
            float facetCosine = dotProduct(wo, facet);
            float weight = node.y * smithG2OverG1(wo.z, stretchWo, wi.z, stretchOf(wi, alpha));
            float expected = schlickReflectance(facetCosine, vec3(normal), 1.0).x;
            sum = sum + weight * (iridescentLoss(film, facetCosine) - expected);
            lit = lit + weight;
        }
    }
    float difference = lit > 0.0 ? divide(sum, lit) : 0.0;
    float lost = energyAt(energy, normal, 1.0) + energy.white * difference;
    return greater(lesser(lost, energy.white), 0.0);
}
