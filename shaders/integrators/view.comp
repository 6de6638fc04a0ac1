// Views of what primary rays meet, and ambient occlusion. Twin: host/reference/view.h.
//
// Ambient occlusion is the share of a white sky that a point sees, weighted by the cosine to its normal, with
// everything further away than `occlusionDistance` left out: Zhukov, Iones and Kronin, "An Ambient Light Illumination
// Model", 1998.
//
// The shadow of a shadow catcher is the share of its direct light that other surfaces keep from it, by luminance: of a
// matt surface in its place, the sum of light samples that are blocked over the sum of all. A sample is 1, the light
// that an empty scene would send, and what of it is blocked. Glass dims it by `shadowThroughGlass`; other shadow
// catchers do not: their shadows are in the picture that they stand for.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

layout(constant_id = constantView) const uint view = viewNormal;

const bool lightPassesGlass = false;
const bool raysHaveTargets = false;
const bool hasBounces = view == viewShadow; // a ray to the light

#include "shaders/kernels/stages.glsl"

void beginSample(uint slot) { sendPrimaryRay(slot); }

void show(uint slot, vec3 value) {
    if (!showsCost)
        path[slot].sampleRadiance = value;
    traceEvent(slot, traceRadiance, 0u, value);
}

// Sends a ray on towards the light, `left` away.
void goToLight(uint slot, Surface surface, float left) {
    vec3 direction = path[slot].scatterDirection;
    path[slot].scatterPdf = left;
    startRay(slot, offsetRayOrigin(surface, direction), direction, path[slot].hitPrimitive, 2u, noMaterial);
}

// On a shadow catcher: aims at a light.
void catchShadow(uint slot, Surface surface) {
    if (dotProduct(path[slot].rayDirection, surface.geometricNormal) > 0.0) {
        surface.normal = -surface.normal;
        surface.geometricNormal = -surface.geometricNormal;
    }
    uvec2 pixel = imagePixel[slot];
    uvec2 choiceBits = sampleBits(pairKeys(pixel, frame.seed, vertexPair(1u, pairChoice)), path[slot].sampleIndex);
    uvec2 lightBits = sampleBits(pairKeys(pixel, frame.seed, vertexPair(1u, pairLight)), path[slot].sampleIndex);
    EmitterChoice choice = chooseEmitter(LitPoint(surface.position, surface.normal, false), choiceBits.x);
    LightSample light = sampleEmitter(choice, surface.position, lightBits);
    float cosine = dotProduct(surface.normal, light.direction);
    bool isLit = cosine > 0.0 && dotProduct(surface.geometricNormal, light.direction) > 0.0;
    float unblocked = isLit ? withoutTiny(luminance(light.radiance) * cosine) : 0.0;
    show(slot, vec3(1.0, unblocked, unblocked));
    if (!(unblocked > 0.0))
        return;
    rayCounts[slot].y += 1u;
    path[slot].scatterDirection = light.direction;
    path[slot].rayTarget = light.target;
    path[slot].isLightDimmed = 0u;
    goToLight(slot, surface, light.distance);
}

// Stage: the nearest surface on the way to the light is known.
void passToLight(uint slot) {
    float left = path[slot].scatterPdf;
    bool isThere = path[slot].hitPrimitive == noPrimitive || path[slot].rayLength >= left ||
                   path[slot].hitPrimitive == path[slot].rayTarget;
    float unblocked = path[slot].sampleRadiance.y;
    if (isThere) {
        bool isDimmed = path[slot].isLightDimmed != 0u;
        float blocked = isDimmed ? unblocked * (1.0 - frame.shadowThroughGlass) : 0.0;
        traceEvent(slot, traceVisibility, isDimmed ? visibilityDimmed : visibilityClear, vec3(0.0));
        show(slot, vec3(1.0, unblocked, blocked));
        return;
    }
    uint materialIndex;
    Surface surface = surfaceHit(slot, materialIndex);
    MaterialRecord material = fetchMaterial(materialIndex);
    bool isDimming = isGlass(material) || isThinGlass(material);
    if (!isDimming && !catchesShadows(material)) {
        traceEvent(slot, traceVisibility, visibilityBlocked, vec3(0.0));
        return;
    }
    if (isDimming)
        path[slot].isLightDimmed = 1u;
    goToLight(slot, surface, left - path[slot].rayLength);
}

// Stage: the nearest hit is known.
void shadeHit(uint slot) {
    traceNearestHit(slot);
    path[slot].stage = stageSampleDone;
    if (view == viewShadow && path[slot].rayDepth > 1u) {
        passToLight(slot);
        return;
    }
    if (path[slot].hitPrimitive == noPrimitive) {
        show(slot, vec3(view == viewOcclusion ? 1.0 : 0.0));
        return;
    }
    uint materialIndex;
    Surface surface = surfaceHit(slot, materialIndex);
    traceEvent(slot, traceSurfacePosition, 0u, surface.position);
    traceEvent(slot, traceSurfaceNormal, 0u, surface.normal);
    if (view == viewNormal)
        show(slot, normalColour(surface.normal));
    if (view == viewDepth)
        show(slot, vec3(path[slot].rayLength));
    if (view == viewId)
        show(slot, idColour(path[slot].hitPrimitive));
    if (view == viewCoordinates) {
        vec2 uv = hitUvs(hitOf(slot), surface.position).first;
        show(slot, vec3(fractionOf(uv.x), fractionOf(uv.y), 0.0));
    }
    if (view == viewAlbedo) {
        MaterialRecord material =
            hitMaterial(hitOf(slot), fetchMaterial(materialIndex), texturesBaseColour, surface.position);
        show(slot, isColourless(material) ? vec3(1.0) : material.albedo);
    }
    if (view == viewShadow && catchesShadows(fetchMaterial(materialIndex)))
        catchShadow(slot, surface);
    if (view >= viewObject)
        show(slot, vec3(floatOf(numberOf(view, path[slot].hitPrimitive, materialIndex))));
    if (view == viewOcclusion) {
        bool isBehind = dotProduct(path[slot].rayDirection, surface.geometricNormal) > 0.0;
        if (isBehind) {
            surface.normal = -surface.normal;
            surface.geometricNormal = -surface.geometricNormal;
        }
        setSurface(slot, surface);
    }
}

// Stage: send a ray to a random point of the sky.
void sampleDirectLight(uint slot) {
    uvec2 bits = sampleBits(pairKeys(imagePixel[slot], frame.seed, occlusionPair), path[slot].sampleIndex);
    vec3 direction = sampleCosine(path[slot].surfaceNormal, unitFloats(bits));
    path[slot].stage = stageSampleDone;
    if (dotProduct(surfaceAt(slot).geometricNormal, direction) > 0.0)
        beginShadow(slot, direction, frame.occlusionDistance);
}

// Stage: the ray has reached the sky, or was blocked.
void addLight(uint slot) {
    path[slot].stage = stageSampleDone;
    bool isVisible = path[slot].hitPrimitive == noPrimitive;
    traceEvent(slot, traceVisibility, isVisible ? visibilityClear : visibilityBlocked, vec3(0.0));
    if (isVisible)
        show(slot, vec3(1.0));
}

void advancePaths() {
    do
        traceRays();
    while (view == viewShadow && !regeneratesPaths && isAtStageUpTo(stageClosest) && stepsTaken < dispatch.stepBudget);
    if (view == viewOcclusion)
        lightSurfaces();
}

void main() { integrate(); }
