// Specular surfaces, mirrors and smooth glass, on paths that choose one direction at each. Twin:
// host/reference/specular.h.
//
// An integrator defines `carriesRadiance`: throughputs are of radiance, which is larger in glass by the square of the
// refractive index; those of colours are not. And `dispersesLight`: glass may split what they are of into waves.

uvec2 vertexBits(uint pair) {
    return sampleBits(pairKeys(path.key.pixel, frame.seed, vertexPair(path.key.depth, pair)), path.key.sampleIndex);
}

void weaken(vec3 factor) { path.throughput = withoutTiny(path.throughput * factor); }

// Transmittance of the glass around the path over a distance, by Beer's law.
vec3 transmittance(uint mediaInside, float distance) {
    uint medium = mediumAround(mediaInside);
    return medium != noMaterial ? expNegative(fetchMaterial(medium).absorption * distance) : vec3(1.0);
}

// The wave that the sample has where its light is dispersed. The indices of glass are for it from the beginning.
Wave waveOfSample() {
    return sampleWave(
        unitFloat(sampleBits(pairKeys(path.key.pixel, frame.seed, wavelengthPair), path.key.sampleIndex).x));
}

// The path has light of one wavelength from here on.
void disperse() {
    if (!path.isDispersed)
        weaken(waveOfSample().colour);
    path.isDispersed = true;
}

float mediumIndex(uint medium) {
    if (medium == noMaterial)
        return 1.0;
    MaterialRecord material = fetchMaterial(medium);
    return dispersesLight ? indexFor(material, waveOfSample().bend) : material.refractiveIndex;
}

bool isDispersive(uint medium) { return medium != noMaterial && fetchMaterial(medium).dispersion > 0.0; }

// The next segment of the path.
void continueRay(vec3 origin, vec3 direction, uint excluded) {
    path.key.depth += 1u;
    askNearest(origin, direction, excluded);
}

void reflectRay(const Answer answer, const Surface surface, vec3 normal) {
    vec3 direction = mirrorDirection(request.ray.direction, normal);
    vec3 origin = offsetRayOrigin(surface, direction);
    path.scatterPdf = 0.0;
    endSeeingThrough();
    scatterLight(vec3(0.0), false);
    path.rays.z += 1u;
    continueRay(origin, direction, answer.hit.primitive);
}

// The media on both sides of a glass surface.
struct Crossing {
    uint before; // counts as in media.glsl
    uint beyond;
    float eta;    // refractive index before divided by the one beyond
    bool isNullInterface; // the same glass is effective on both sides
    bool isDispersing;    // what passes is dispersed
};

Crossing crossingOf(uint before, uint materialIndex, bool isEntering) {
    // Glass that is left without having been entered changes nothing: paths begin in what is around the eye.
    uint beyond = isEntering ? enterMedium(before, materialIndex) : leaveMedium(before, materialIndex);
    uint medium = mediumAround(before);
    uint mediumBeyond = mediumAround(beyond);
    bool disperses = dispersesLight && (isDispersive(medium) || isDispersive(mediumBeyond));
    return Crossing(before, beyond, divide(mediumIndex(medium), mediumIndex(mediumBeyond)), medium == mediumBeyond,
                    disperses);
}

// Whether the light is reflected and keeps all its waves: they differ little in how much of them is, unless all of some
// is, on the side of the higher index.
bool isReflectedWhole(Crossing crossing, bool isReflected) { return isReflected && crossing.eta < 1.0; }

// Smooth glass: chooses reflection or refraction with the probability of its share. Inside glass of higher priority the
// path passes straight through. Returns whether light is refracted.
bool scatterSmoothDielectric(const Answer answer, const Surface surface,
                             uint materialIndex) {
    vec3 direction = request.ray.direction;
    bool isEntering = dotProduct(direction, surface.geometricNormal) < 0.0;
    Crossing crossing = crossingOf(path.mediaInside, materialIndex, isEntering);
    if (crossing.isNullInterface) {
        path.mediaInside = crossing.beyond;
        path.scatterPdf = 0.0; // light samples do not pass glass
        continueRay(offsetRayOrigin(surface, direction), direction, answer.hit.primitive);
        return false;
    }
    vec3 geometricFacing = isEntering ? surface.geometricNormal : -surface.geometricNormal;
    vec3 shadingFacing = isEntering ? surface.normal : -surface.normal;
    vec3 facing = dotProduct(direction, shadingFacing) < 0.0 ? shadingFacing : geometricFacing;
    float eta = crossing.eta;
    DielectricFresnel glass = fresnelDielectric(direction, facing, eta);
    traceEvent(traceReflectance, glass.reflectance == 1.0 ? 1u : 0u, vec3(glass.reflectance));
    bool isReflected = unitFloat(vertexBits(pairChoice).x) < glass.reflectance;
    if (crossing.isDispersing && !isReflectedWhole(crossing, isReflected))
        disperse();
    if (isReflected) {
        path.mediaInside = crossing.before;
        reflectRay(answer, surface, facing);
        return false;
    }
    path.mediaInside = crossing.beyond;
    if (carriesRadiance) {
        float squaredEta = eta * eta;
        path.throughput *= squaredEta;
    }
    path.scatterPdf = 0.0;
    scatterLight(vec3(0.0), true);
    path.rays.w += 1u;
    continueRay(offsetRayOrigin(surface, glass.refracted), glass.refracted, answer.hit.primitive);
    return true;
}

// Whether the surface is a mirror or clear glass. Rough glass with the same index on both sides is clear, unless it is a
// mixture, which has other parts and a colour.
bool isSpecularHere(uint mediaInside, const MaterialRecord material, uint materialIndex, bool isEntering) {
    if ((scattering & (scattersAtRoughGlass | scattersAtDiffuseTransmission)) != 0u && holdsMedium(material) &&
        material.alpha > 0.0) {
        Crossing crossing = crossingOf(mediaInside, materialIndex, isEntering);
        return crossing.isNullInterface || !isMixture(material) && crossing.eta == 1.0;
    }
    return isSpecular(material);
}
