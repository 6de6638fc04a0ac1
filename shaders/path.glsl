// The path integrator: one path a sample, with next-event estimation at diffuse surfaces, combined with what scattered rays
// find by multiple importance sampling, and Russian roulette. Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach,
// "Robust Monte Carlo Methods for Light Transport Simulation", 1997, sections 9 and 10.
// Twin: host/reference/path.h, where the same happens vertex by vertex.
//
// `maxDepth` bounds the segments of a path from the eye to the light, so that neither technique finds longer paths than
// the other. Each vertex has three pairs of random numbers.

const uint pairChoice = 0u; // an emitter, or a side of an interface; and whether the path survives
const uint pairLight = 1u;
const uint pairScatter = 2u;
const uint pairsPerVertex = 3u;

const uint firstRouletteDepth = 4u; // segments that no path is denied

uvec2 vertexBits(uint slot, uint pair) {
    uint number = 1u + pairsPerVertex * (path[slot].rayDepth - 1u) + pair;
    return sampleBits(pairKeys(imagePixel[slot], frame.seed, number), path[slot].sampleIndex);
}

void beginSample(uint slot) {
    sendPrimaryRay(slot);
    path[slot].scatterDensity = 0.0;
    path[slot].mediaInside = 0u;
}

void endPath(uint slot) { path[slot].stage = stageSampleDone; }

void addRadiance(uint slot, vec3 weight, vec3 radiance) {
    path[slot].sampleRadiance = addProduct(path[slot].sampleRadiance, weight, radiance);
    traceEvent(slot, traceRadiance, 0u, path[slot].sampleRadiance);
}

// What a surface that the ray has met emits towards it, weighted against aiming at the same point.
void addEmission(uint slot, Surface surface, MaterialRecord material) {
    vec3 direction = path[slot].rayDirection;
    precise float facing = -dotProduct(direction, surface.geometricNormal);
    float cosine = material.isTwoSided != 0u ? abs(facing) : facing;
    if (material.emitterDensity <= 0.0 || cosine <= 0.0)
        return;
    float weight = 1.0;
    if (path[slot].scatterDensity > 0.0) {
        float density;
        if (hasTriangles && path[slot].hitPrimitive >= firstTriangleId) {
            density = solidAngleDensity(material.emitterDensity, path[slot].rayLength, cosine);
        } else {
            SphereRecord sphere = fetchSphere(path[slot].hitRecord);
            density = sphereLightDensity(path[slot].rayOrigin, direction, path[slot].rayLength, sphere.centre, sphere.radius,
                                         surface.normal * sphere.normalSign, material.emitterDensity);
        }
        weight = powerHeuristic(path[slot].scatterDensity, density);
    }
    addRadiance(slot, path[slot].throughput * weight, material.emission);
}

// What glass around the path leaves of light after this distance.
vec3 transmittance(uint slot, float distance) {
    uint medium = mediumAround(path[slot].mediaInside);
    return medium != noMaterial ? decay(fetchMaterial(medium).absorption * distance) : vec3(1.0);
}

float mediumIndex(uint medium) { return medium != noMaterial ? fetchMaterial(medium).refractiveIndex : 1.0; }

// Lets long paths of little weight end by chance, and gives the others their weight.
bool survivesRoulette(uint slot) {
    if (path[slot].rayDepth < firstRouletteDepth)
        return true;
    float index = hasDielectric ? mediumIndex(mediumAround(path[slot].mediaInside)) : 1.0;
    // Radiance in glass is larger by the square of the index, which it loses on its way out.
    precise float survival = lesser(largestComponent(path[slot].throughput) * (index * index), 1.0);
    if (unitFloat(vertexBits(slot, pairChoice).y) >= survival)
        return false;
    path[slot].throughput *= divide(1.0, survival);
    return true;
}

void continueRay(uint slot, vec3 origin, vec3 direction, uint excluded) {
    startRay(slot, origin, direction, excluded, path[slot].rayDepth + 1u, noMaterial);
}

void reflectRay(uint slot, Surface surface, vec3 normal) {
    vec3 direction = mirrorDirection(path[slot].rayDirection, normal);
    vec3 origin = spawnPoint(surface.position, surface.error, surface.geometricNormal, direction);
    path[slot].scatterDensity = 0.0;
    rayCounts[slot].z += 1u;
    continueRay(slot, origin, direction, path[slot].hitPrimitive);
}

// At glass: nothing, where glass of higher priority is on both sides; else one of reflection and refraction, chosen with the
// probability of its share.
void meetGlass(uint slot, Surface surface, uint materialIndex) {
    vec3 direction = path[slot].rayDirection;
    uint inside = path[slot].mediaInside;
    bool isEntering = dotProduct(direction, surface.geometricNormal) < 0.0;
    // A path that leaves glass which it has not entered began in it.
    uint insideBefore = isEntering || mediumCount(inside, materialIndex) > 0u ? inside : enterMedium(inside, materialIndex);
    uint insideBeyond = isEntering ? enterMedium(inside, materialIndex) : leaveMedium(inside, materialIndex);
    uint before = mediumAround(insideBefore);
    uint beyond = mediumAround(insideBeyond);
    if (before == beyond) {
        path[slot].mediaInside = insideBeyond;
        path[slot].scatterDensity = 0.0; // no light is aimed at through glass
        continueRay(slot, spawnPoint(surface.position, surface.error, surface.geometricNormal, direction), direction,
                    path[slot].hitPrimitive);
        return;
    }
    vec3 geometricFacing = isEntering ? surface.geometricNormal : -surface.geometricNormal;
    vec3 shadingFacing = isEntering ? surface.normal : -surface.normal;
    vec3 facing = dotProduct(direction, shadingFacing) < 0.0 ? shadingFacing : geometricFacing;
    float eta = divide(mediumIndex(before), mediumIndex(beyond));
    Interface glass = meetInterface(direction, facing, eta);
    traceEvent(slot, traceReflectance, glass.reflectance == 1.0 ? 1u : 0u, vec3(glass.reflectance));
    if (unitFloat(vertexBits(slot, pairChoice).x) < glass.reflectance) {
        path[slot].mediaInside = insideBefore;
        reflectRay(slot, surface, facing);
        return;
    }
    path[slot].mediaInside = insideBeyond;
    precise float squaredEta = eta * eta;
    path[slot].throughput *= squaredEta;
    path[slot].scatterDensity = 0.0;
    rayCounts[slot].w += 1u;
    continueRay(slot, spawnPoint(surface.position, surface.error, surface.geometricNormal, glass.refracted), glass.refracted,
                path[slot].hitPrimitive);
}

// Stage: the nearest hit is known.
void shadeHit(uint slot) {
    traceNearestHit(slot);
    endPath(slot);
    if (hasDielectric)
        path[slot].throughput *= transmittance(slot, path[slot].rayLength);
    if (path[slot].hitPrimitive == noPrimitive) {
        addRadiance(slot, path[slot].throughput, frame.background);
        return;
    }
    uint materialIndex;
    Surface surface = hitSurface(slot, materialIndex);
    MaterialRecord material = fetchMaterial(materialIndex);
    traceEvent(slot, traceSurfacePosition, 0u, surface.position);
    traceEvent(slot, traceSurfaceNormal, 0u, surface.normal);
    traceEvent(slot, traceThroughput, 0u, path[slot].throughput);
    if (hasEmission)
        addEmission(slot, surface, material);
    if (path[slot].rayDepth >= frame.maxDepth)
        return;
    if (!hasSpecular || material.kind == materialDiffuse) {
        if (dotProduct(path[slot].rayDirection, surface.geometricNormal) > 0.0) {
            if (material.isTwoSided == 0u)
                return;
            surface.normal = -surface.normal;
            surface.geometricNormal = -surface.geometricNormal;
        }
        standOn(slot, surface);
        path[slot].throughput *= material.albedo;
        return;
    }
    if (!survivesRoulette(slot))
        return;
    if (hasDielectric && material.kind == materialDielectric)
        meetGlass(slot, surface, materialIndex);
    else
        reflectRay(slot, surface, surface.normal);
}

// The path goes on from a diffuse surface, in a direction that was drawn when it was lit.
void scatter(uint slot) {
    endPath(slot);
    vec3 direction = path[slot].scatterDirection;
    bool isAbove = path[slot].scatterDensity > 0.0 && dotProduct(path[slot].surfaceGeometricNormal, direction) > 0.0;
    if (!isAbove || !survivesRoulette(slot))
        return;
    traceEvent(slot, traceScatter, floatBitsToUint(path[slot].scatterDensity), direction);
    bounceCounts[slot] += 1u;
    continueRay(slot, spawnPoint(path[slot].surfacePosition, path[slot].surfaceError, path[slot].surfaceGeometricNormal,
                                 direction),
                direction, path[slot].surfacePrimitive);
}

// Stage: on a diffuse surface, draw the direction in which the path will go on, and aim at a light.
void aimAtLight(uint slot) {
    vec3 normal = path[slot].surfaceNormal;
    path[slot].scatterDirection = sampleCosine(normal, unitFloats(vertexBits(slot, pairScatter)));
    path[slot].scatterDensity = pdfCosine(dotProduct(normal, path[slot].scatterDirection));

    uint emitter = chooseEmitter(vertexBits(slot, pairChoice).x);
    LightSample light = sampleEmitter(emitter, path[slot].surfacePosition, unitFloats(vertexBits(slot, pairLight)));
    float cosine = dotProduct(normal, light.direction);
    bool isLit = largestComponent(light.radiance) > 0.0 && cosine > 0.0 &&
                 dotProduct(path[slot].surfaceGeometricNormal, light.direction) > 0.0;
    if (!isLit) {
        traceEvent(slot, traceVisibility, visibilityUnlit, vec3(emitter));
        scatter(slot);
        return;
    }
    float reflected = pdfCosine(cosine); // also the density of a scattered ray
    float share = light.density > 0.0 ? reflected * powerHeuristic(light.density, reflected) : reflected;
    path[slot].surfaceWeight = path[slot].throughput * (light.radiance * share);
    if (hasDielectric)
        path[slot].surfaceWeight *= transmittance(slot, light.distance);
    path[slot].rayTarget = light.target;
    path[slot].lightIndex = emitter;
    beginShadow(slot, light.direction, light.distance);
}

// Stage: the shadow ray has arrived, or was stopped.
void addLight(uint slot) {
    bool isVisible = path[slot].hitPrimitive == noPrimitive;
    traceEvent(slot, traceVisibility, isVisible ? visibilityClear : visibilityBlocked, vec3(path[slot].lightIndex));
    if (isVisible)
        addRadiance(slot, path[slot].surfaceWeight, vec3(1.0));
    scatter(slot);
}

// Of the search for an emitter, in all slots.
uint searchIterations() { return emitterCount > 1u ? RAYS * uint(findMSB(emitterCount) + 1) : 0u; }

void advancePaths() {
    do {
        do
            traceRays();
        while (hasSpecular && isAtStageUpTo(stageClosest) && stepsTaken < dispatch.stepBudget);
        lightSurfaces();
        stepsTaken += 1u + searchIterations();
    } while (isAtStageUpTo(stageShadow) && stepsTaken < dispatch.stepBudget);
}
