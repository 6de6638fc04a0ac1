// The path integrator: one path a sample, with next-event estimation at diffuse and rough surfaces, combined with what
// scattered rays find by multiple importance sampling, and Russian roulette. Kajiya, "The Rendering Equation", SIGGRAPH
// 1986; Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, sections 9 and 10. Twin:
// host/reference/path.h, where the same happens vertex by vertex.
//
// `maxDepth` bounds the segments of a path from the eye to the light, so that neither technique finds longer paths than
// the other.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

const bool lightPassesGlass = false;
const bool raysHaveTargets = hasEmission;
const bool hasBounces = true;
const bool carriesRadiance = true;

#include "shaders/kernels/stages.glsl"
#include "shaders/integrators/specular.glsl"

const uint firstRouletteDepth = 4u; // segments before Russian roulette begins

vec2 lobeChoice(uint slot) {
    uint number = lobePair(path[slot].rayDepth);
    return unitFloats(sampleBits(pairKeys(imagePixel[slot], frame.seed, number), path[slot].sampleIndex));
}

void beginSample(uint slot) {
    beginInMedia(slot);
    beginTransparency(slot);
    beginLight(slot);
    path[slot].scatterPdf = 0.0;
}

void endPath(uint slot) { path[slot].stage = stageSampleDone; }

// Returns what the sample has gained.
vec3 addRadiance(uint slot, vec3 weight, vec3 radiance) {
    vec3 added = withoutTiny(weight * radiance);
    if (path[slot].rayDepth > 1u)
        added = lesser(added, vec3(frame.radianceLimit));
    if (!showsCost)
        path[slot].sampleRadiance = path[slot].sampleRadiance + added;
    traceEvent(slot, traceRadiance, 0u, path[slot].sampleRadiance);
    return added;
}

// The surface that the path was on before its ray, as the light tree sees it.
LitPoint litPoint(uint slot) {
    bool isTransmitting =
        scattering != 0u && isLitFromBehind(fetchMaterial(path[slot].surfaceMaterial & ~seenFromBehind));
    return LitPoint(path[slot].surfacePosition, path[slot].surfaceNormal, isTransmitting);
}

// Emission of the surface at the hit, with the multiple importance weight against a light sample of the same point.
void addEmission(uint slot, Surface surface, MaterialRecord material) {
    vec3 direction = path[slot].rayDirection;
    float facing = -dotProduct(direction, surface.geometricNormal);
    float cosine = emitsBehind(material) ? abs(facing) : facing;
    if (material.emitterPdf <= 0.0 || cosine <= 0.0)
        return;
    float weight = 1.0;
    if (path[slot].scatterPdf > 0.0) {
        float pdf;
        // Every emitting sphere is an emitter, unless its radius is 0, and then nothing hits it.
        if ((lighting & lightsBySpheres) == 0u || isTriangle(path[slot].hitPrimitive)) {
            float areaPdf = material.emitterPdf;
            if (hasLightTree)
                areaPdf = pdfOfEmitter(fetchTriangle(path[slot].hitRecord).flags >> triangleEmitterShift, areaPdf,
                                       litPoint(slot));
            pdf = solidAnglePdf(areaPdf, path[slot].rayLength, cosine);
        } else {
            SphereRecord sphere = fetchSphere(path[slot].hitRecord);
            float areaPdf = pdfOfEmitter(sphere.emitter, material.emitterPdf, litPoint(slot));
            pdf = pdfSphereLight(path[slot].rayOrigin, direction, path[slot].rayLength, sphere.centre, sphere.radius,
                                         surface.normal * normalSignOf(sphere), areaPdf);
        }
        weight = powerHeuristic(path[slot].scatterPdf, pdf);
    }
    vec3 added = addRadiance(slot, path[slot].throughput * weight, material.emission);
    meetLight(slot, added, lightEmission, material.lightGroup);
}

// Radiance from outside the scene, with the multiple importance weight against a light sample in that direction.
void addEnvironment(uint slot) {
    if ((lighting & lightsByEnvironment) == 0u) {
        vec3 added = addRadiance(slot, path[slot].throughput, frame.background);
        meetLight(slot, added, lightBackground, frame.environmentGroup);
        return;
    }
    EnvironmentLight found = environmentFrom(path[slot].rayDirection);
    float pdf = found.pdf * frame.environmentProbability;
    float weight = path[slot].scatterPdf > 0.0 ? powerHeuristic(path[slot].scatterPdf, pdf) : 1.0;
    vec3 added = addRadiance(slot, path[slot].throughput * weight, found.radiance);
    meetLight(slot, added, lightBackground, frame.environmentGroup);
}

// Russian roulette: long paths with a small throughput end at random, and the others gain their weight.
bool survivesRoulette(uint slot) {
    if (path[slot].rayDepth < firstRouletteDepth)
        return true;
    float index = hasDielectric ? mediumIndex(mediumAround(path[slot].mediaInside)) : 1.0;
    // Radiance in glass is larger by the square of the refractive index; the path will lose that factor on its way out.
    float survival = lesser(largestComponent(path[slot].throughput) * (index * index), 1.0);
    if (unitFloat(vertexBits(slot, pairChoice).y) >= survival)
        return false;
    path[slot].throughput *= divide(1.0, survival);
    return true;
}

// Slots of the textures that say what a path does at a hit. Those that only the BSDF needs are looked up when it is
// made.
uint slotsBeforeLight(MaterialRecord material) {
    uint slots = texturesEmission | texturesTransmission;
    if (showsBaseColour(material))
        slots |= texturesBaseColour;
    if (!isMixture(material)) // so that it may be specular
        slots |= texturesRoughness;
    return slots;
}

// The material of the hit at `position`, with its textures of `textureSlots` applied. The lookups are a loop: they
// count as steps.
MaterialRecord materialHit(uint slot, MaterialRecord material, uint textureSlots, vec3 position) {
    stepsTaken += uint(bitCount(textureSlots & texturing & texturesOfLobes));
    return hitMaterial(hitOf(slot), material, textureSlots, position);
}

void shadePath(uint slot) {
    traceNearestHit(slot);
    endPath(slot);
    if (hasDielectric)
        weaken(slot, transmittance(slot, path[slot].rayLength));
    if (path[slot].hitPrimitive == noPrimitive) {
        if (seesThrough(slot))
            becomeTransparent(slot, path[slot].throughput);
        else
            addEnvironment(slot);
        return;
    }
    uint materialIndex;
    Surface surface = surfaceHit(slot, materialIndex);
    MaterialRecord material = fetchMaterial(materialIndex);
    material = materialHit(slot, material, slotsBeforeLight(material), surface.position);
    traceEvent(slot, traceSurfacePosition, 0u, surface.position);
    traceEvent(slot, traceSurfaceNormal, 0u, surface.normal);
    traceEvent(slot, traceThroughput, 0u, path[slot].throughput);
    if (seesThrough(slot) && catchesShadows(material)) {
        becomeTransparent(slot, path[slot].throughput);
        return;
    }
    if (alphaKind == alphaOfBackground)
        endSeeingThrough(slot);
    if (showsBaseColour(material)) {
        vec3 added = addRadiance(slot, path[slot].throughput, material.albedo);
        meetLight(slot, added, lightEmission, material.lightGroup);
        return;
    }
    if (hasEmission)
        addEmission(slot, surface, material);
    if (path[slot].rayDepth >= frame.maxDepth)
        return;
    bool isBehind = dotProduct(path[slot].rayDirection, surface.geometricNormal) > 0.0;
    if (scattering != 0u ? !isSpecularHere(slot, material, materialIndex, !isBehind)
                         : !hasSpecular || !isSpecular(material)) {
        if (isBehind) {
            if (isBlackBehind(material))
                return;
            surface.normal = -surface.normal;
            surface.geometricNormal = -surface.geometricNormal;
        }
        setSurface(slot, surface);
        path[slot].surfaceMaterial = materialIndex | (isBehind ? seenFromBehind : 0u);
        return;
    }
    if (!survivesRoulette(slot))
        return;
    if (hasDielectric && isGlass(material)) {
        scatterSmoothDielectric(slot, surface, materialIndex);
    } else {
        if (scattering != 0u)
            weaken(slot, mirrorReflectance(material, abs(dotProduct(path[slot].rayDirection, surface.normal))));
        reflectRay(slot, surface, surface.normal);
    }
}

// Stage: the nearest hit is known.
void shadeHit(uint slot) {
    beginHitLight(slot);
    shadePath(slot);
    endHitLight(slot);
}

// Continues the path from a surface, in the direction that was sampled when the surface was lit.
void scatter(uint slot) {
    endPath(slot);
    vec3 direction = path[slot].scatterDirection;
    if (!(path[slot].scatterPdf > 0.0) || !survivesRoulette(slot))
        return;
    traceEvent(slot, traceScatter, floatBitsToUint(path[slot].scatterPdf), direction);
    bounceCounts[slot] += 1u;
    continueRay(slot, offsetRayOrigin(surfaceAt(slot), direction), direction, path[slot].surfacePrimitive);
}

void skipShadowRay(uint slot, uint emitter) {
    traceEvent(slot, traceVisibility, visibilityUnlit, vec3(emitter));
    scatter(slot);
}

// Sends a shadow ray to the light sample.
void aimShadowRay(uint slot, uint emitter, LightSample light) {
    path[slot].rayTarget = light.target;
    path[slot].lightIndex = emitter;
    beginShadow(slot, light.direction, light.distance);
}

// Stage: on a surface, sample the direction in which the path continues, and a light.
void sampleDirectLight(uint slot) {
    uint materialIndex = path[slot].surfaceMaterial & ~seenFromBehind;
    bool isBehind = (path[slot].surfaceMaterial & seenFromBehind) != 0u;
    MaterialRecord material =
        materialHit(slot, fetchMaterial(materialIndex), texturesOfLobes | texturesBaseColour,
                    path[slot].surfacePosition);
    vec3 geometricNormal = surfaceAt(slot).geometricNormal;
    Crossing crossing = Crossing(path[slot].mediaInside, path[slot].mediaInside, 1.0, true);
    if ((scattering & scattersAtRoughGlass) != 0u && isGlass(material))
        crossing = crossingOf(slot, materialIndex, !isBehind);
    vec2 lobe = lobeChoice(slot);
    SurfaceAxes axes = hitAxes(hitOf(slot), path[slot].rayOrigin, path[slot].rayDirection, material,
                               path[slot].surfaceNormal, isBehind);
    Bsdf bsdf = makeBsdf(material, path[slot].rayDirection, path[slot].surfaceNormal, geometricNormal, axes, isBehind,
                          crossing.eta, lobe.x);

    EmitterChoice choice = chooseEmitter(litPoint(slot), vertexBits(slot, pairChoice).x);
    uint emitter = choice.index;
    LightSample light = sampleEmitter(choice, path[slot].surfacePosition, vertexBits(slot, pairLight));
    vec3 wiLight = toLocal(bsdf.frame, light.direction);
    bool isLightBeyond = dotProduct(geometricNormal, light.direction) <= 0.0;
    BsdfEval lit = evalBsdf(bsdf, wiLight);
    bool isLit = largestComponent(light.radiance) > 0.0 && lit.pdf > 0.0 && isLightBeyond == (wiLight.z <= 0.0);
    // What shines through is seen by the scattered ray, as what it is.
    bool isWindow = alphaKind == alphaThroughGlass && seesThrough(slot) && isClearGlass(material);
    if (isWindow && isLit && isLightBeyond)
        isLit = fetchEmitter(emitter).kind != emitterEnvironment;
    float share = light.pdf > 0.0 ? powerHeuristic(light.pdf, lit.pdf) : 1.0;
    path[slot].surfaceWeight = path[slot].throughput * (light.radiance * (lit.value * share));
    if (hasDielectric) {
        path[slot].mediaInside = isLightBeyond ? crossing.beyond : crossing.before;
        path[slot].surfaceWeight *= transmittance(slot, light.distance);
    }

    vec3 wi = sampleBsdf(bsdf, unitFloats(vertexBits(slot, pairScatter)), lobe.y);
    vec3 direction = unitVector(toWorld(bsdf.frame, wi));
    BsdfEval scattered = evalBsdf(bsdf, wi);
    bool isBeyond = dotProduct(geometricNormal, direction) <= 0.0;
    bool isPossible = scattered.pdf > 0.0 && isBeyond == (wi.z <= 0.0);
    path[slot].scatterDirection = direction;
    path[slot].scatterPdf = isPossible ? scattered.pdf : 0.0;
    if (hasLightClasses && !isLightDiffuse) {
        aimLight(slot, diffuseShare(bsdf, wiLight, lit.value), isLightBeyond);
        scatterLight(slot, diffuseShare(bsdf, wi, scattered.value), isBeyond);
    } else {
        scatterLight(slot, vec3(1.0), false);
    }
    if (!(isWindow && isBeyond))
        endSeeingThrough(slot);
    if (hasDielectric)
        path[slot].mediaInside = isBeyond ? crossing.beyond : crossing.before;
    weaken(slot, isPossible ? scattered.value * divide(1.0, scattered.pdf) : vec3(0.0));
    if (isLit)
        aimShadowRay(slot, emitter, light);
    else
        skipShadowRay(slot, emitter);
}

// Stage: the shadow ray has arrived, or was stopped.
void addLight(uint slot) {
    bool isVisible = path[slot].hitPrimitive == noPrimitive;
    traceEvent(slot, traceVisibility, isVisible ? visibilityClear : visibilityBlocked, vec3(path[slot].lightIndex));
    if (isVisible) {
        vec3 added = addRadiance(slot, path[slot].surfaceWeight, vec3(1.0));
        if (hasLightPlanes)
            addSampledLight(slot, added, lightGroupOf(fetchEmitter(path[slot].lightIndex)));
    }
    scatter(slot);
}

// Work of the search for an emitter, in all slots.
uint searchIterations() {
    // Of the light tree, this is the usual depth, too.
    uint emitters = emitterCount > 1u ? RAYS * uint(findMSB(emitterCount) + 1) : 0u;
    uint texels = (lighting & lightsByEnvironment) != 0u
                      ? RAYS * uint(findMSB(frame.environmentWidth) + findMSB(frame.environmentHeight) + 2)
                      : 0u;
    return emitters + texels;
}

void advancePaths() {
    do {
        do
            traceRays();
        while (!regeneratesPaths && hasSpecular && isAtStageUpTo(stageClosest) && stepsTaken < dispatch.stepBudget);
        lightSurfaces();
        stepsTaken += 1u + searchIterations();
    } while (!regeneratesPaths && isAtStageUpTo(stageShadow) && stepsTaken < dispatch.stepBudget);
}

void main() { integrate(); }
