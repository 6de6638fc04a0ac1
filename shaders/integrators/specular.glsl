// Specular surfaces, mirrors and smooth glass, on paths that choose one direction at each. Twin:
// host/reference/specular.h.
//
// An integrator defines `carriesRadiance`: throughputs are of radiance, which is larger in glass by the square of the
// refractive index; those of colours are not.

uvec2 vertexBits(uint slot, uint pair) {
    uint number = vertexPair(path[slot].rayDepth, pair);
    return sampleBits(pairKeys(imagePixel[slot], frame.seed, number), path[slot].sampleIndex);
}

void weaken(uint slot, vec3 factor) { path[slot].throughput = withoutTiny(path[slot].throughput * factor); }

// Transmittance of the glass around the path over a distance, by Beer's law.
vec3 transmittance(uint slot, float distance) {
    uint medium = mediumAround(path[slot].mediaInside);
    return medium != noMaterial ? expNegative(fetchMaterial(medium).absorption * distance) : vec3(1.0);
}

float mediumIndex(uint medium) { return medium != noMaterial ? fetchMaterial(medium).refractiveIndex : 1.0; }

void continueRay(uint slot, vec3 origin, vec3 direction, uint excluded) {
    startRay(slot, origin, direction, excluded, path[slot].rayDepth + 1u, noMaterial);
}

void reflectRay(uint slot, Surface surface, vec3 normal) {
    vec3 direction = mirrorDirection(path[slot].rayDirection, normal);
    vec3 origin = offsetRayOrigin(surface, direction);
    path[slot].scatterPdf = 0.0;
    endSeeingThrough(slot);
    scatterLight(slot, vec3(0.0), false);
    rayCounts[slot].z += 1u;
    continueRay(slot, origin, direction, path[slot].hitPrimitive);
}

// The media on both sides of a glass surface.
struct Crossing {
    uint before; // counts as in media.glsl
    uint beyond;
    float eta;    // refractive index before divided by the one beyond
    bool isNullInterface; // the same glass is effective on both sides
};

Crossing crossingOf(uint slot, uint materialIndex, bool isEntering) {
    // Glass that is left without having been entered changes nothing: paths begin in what is around the eye.
    uint before = path[slot].mediaInside;
    uint beyond = isEntering ? enterMedium(before, materialIndex) : leaveMedium(before, materialIndex);
    uint medium = mediumAround(before);
    uint mediumBeyond = mediumAround(beyond);
    return Crossing(before, beyond, divide(mediumIndex(medium), mediumIndex(mediumBeyond)), medium == mediumBeyond);
}

// Smooth glass: chooses reflection or refraction with the probability of its share. Inside glass of higher priority the
// path passes straight through. Returns whether light is refracted.
bool scatterSmoothDielectric(uint slot, Surface surface, uint materialIndex) {
    vec3 direction = path[slot].rayDirection;
    bool isEntering = dotProduct(direction, surface.geometricNormal) < 0.0;
    Crossing crossing = crossingOf(slot, materialIndex, isEntering);
    if (crossing.isNullInterface) {
        path[slot].mediaInside = crossing.beyond;
        path[slot].scatterPdf = 0.0; // light samples do not pass glass
        continueRay(slot, offsetRayOrigin(surface, direction), direction, path[slot].hitPrimitive);
        return false;
    }
    vec3 geometricFacing = isEntering ? surface.geometricNormal : -surface.geometricNormal;
    vec3 shadingFacing = isEntering ? surface.normal : -surface.normal;
    vec3 facing = dotProduct(direction, shadingFacing) < 0.0 ? shadingFacing : geometricFacing;
    float eta = crossing.eta;
    DielectricFresnel glass = fresnelDielectric(direction, facing, eta);
    traceEvent(slot, traceReflectance, glass.reflectance == 1.0 ? 1u : 0u, vec3(glass.reflectance));
    if (unitFloat(vertexBits(slot, pairChoice).x) < glass.reflectance) {
        path[slot].mediaInside = crossing.before;
        reflectRay(slot, surface, facing);
        return false;
    }
    path[slot].mediaInside = crossing.beyond;
    if (carriesRadiance) {
        float squaredEta = eta * eta;
        path[slot].throughput *= squaredEta;
    }
    path[slot].scatterPdf = 0.0;
    scatterLight(slot, vec3(0.0), true);
    rayCounts[slot].w += 1u;
    continueRay(slot, offsetRayOrigin(surface, glass.refracted), glass.refracted, path[slot].hitPrimitive);
    return true;
}

// Whether the surface is a mirror or clear glass. Rough glass with the same index on both sides is clear.
bool isSpecularHere(uint slot, MaterialRecord material, uint materialIndex, bool isEntering) {
    if ((scattering & scattersAtRoughGlass) != 0u && isGlass(material) && material.alpha > 0.0) {
        Crossing crossing = crossingOf(slot, materialIndex, isEntering);
        return crossing.isNullInterface || crossing.eta == 1.0;
    }
    return isSpecular(material);
}
