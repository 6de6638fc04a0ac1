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
//
// Normals, depths and albedos may look through mirrors and clear glass (isLookedThrough), as auxiliary layers of
// denoisers do: they are those of the first other surface of the path that the path integrator would follow, or of the
// last one that maxDepth allows. The albedo is multiplied by the colours of mirrors and glass on the way; the depth is
// the length of the path; normals are turned towards the ray. Paths that leave the scene show 0.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

layout(constant_id = constantView) const uint view = viewNormal;
layout(constant_id = constantLooksThrough) const bool looksThrough = false;

const bool lightPassesGlass = false;
const bool raysHaveTargets = false;
const bool hasBounces = view == viewShadow; // a ray to the light
const bool hasSegments = view == viewShadow || looksThrough;
const bool carriesRadiance = false;

#include "shaders/kernels/stages.glsl"
#include "shaders/integrators/specular.glsl"

// Textures that say whether a material is looked through, and what it reflects.
const uint texturesOfClearness = texturesRoughness | texturesMetallic | texturesTransmission |
                                 1u << slotDielectricWeight | 1u << slotDielectricColour |
                                 (view == viewAlbedo ? texturesBaseColour : 0u);

void beginSample(uint slot) {
    if (looksThrough)
        beginInMedia(slot);
    else
        sendPrimaryRay(slot);
}

void show(uint slot, vec3 value) {
    if (!showsCost)
        path[slot].sampleRadiance = value;
    traceEvent(slot, traceRadiance, 0u, value);
}

// The surface as it is seen from the ray's side.
Surface facing(uint slot, Surface surface) {
    if (dotProduct(path[slot].rayDirection, surface.geometricNormal) > 0.0) {
        surface.normal = -surface.normal;
        surface.geometricNormal = -surface.geometricNormal;
    }
    return surface;
}

// Sends a ray on towards the light, `left` away.
void goToLight(uint slot, Surface surface, float left) {
    vec3 direction = path[slot].scatterDirection;
    path[slot].scatterPdf = left;
    startRay(slot, offsetRayOrigin(surface, direction), direction, path[slot].hitPrimitive, 2u, noMaterial);
}

// On a shadow catcher: aims at a light.
void catchShadow(uint slot, Surface surface) {
    LitPoint point = LitPoint(surface.position, surface.normal, false);
    EmitterChoice choice = chooseEmitter(point, vertexBits(slot, pairChoice).x);
    LightSample light = sampleEmitter(choice, surface.position, vertexBits(slot, pairLight));
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

// Thin glass: chooses reflection or passes straight through.
void scatterThinGlass(uint slot, Surface surface, MaterialRecord material) {
    vec3 direction = path[slot].rayDirection;
    vec3 reflectance = schlickReflectance(abs(dotProduct(direction, surface.normal)), dielectricReflectance(material),
                                          material.dielectricWeight);
    if (unitFloat(vertexBits(slot, pairChoice).x) < largestComponent(reflectance)) {
        reflectRay(slot, surface, surface.normal);
        return;
    }
    weaken(slot, glassTint(material));
    continueRay(slot, offsetRayOrigin(surface, direction), direction, path[slot].hitPrimitive);
}

// Whether the material may be looked through with its textures, which only take from metal and glass: before they are
// looked up. Rough glass may have its own index around it.
bool mayBeLookedThrough(MaterialRecord material) {
    if (material.textures != 0u && isTextured(material.textures, slotRoughness))
        material.alpha = clearAlpha;
    return isGlass(material) || isLookedThrough(material);
}

// Sends the ray on, and returns true, if the surface is looked through.
bool lookThrough(uint slot, Surface surface, uint materialIndex) {
    MaterialRecord material = fetchMaterial(materialIndex);
    if (path[slot].rayDepth >= frame.maxDepth || !mayBeLookedThrough(material))
        return false;
    stepsTaken += uint(bitCount(texturesOfClearness & texturing));
    material = hitMaterial(hitOf(slot), material, texturesOfClearness, surface.position);
    vec3 direction = path[slot].rayDirection;
    bool isBehind = dotProduct(direction, surface.geometricNormal) > 0.0;
    bool isClear = isSpecularHere(slot, material, materialIndex, !isBehind) || isLookedThrough(material);
    if (!isClear || (isBehind && isMixture(material) && isBlackBehind(material)))
        return false;
    if (view == viewDepth)
        show(slot, path[slot].sampleRadiance + vec3(path[slot].rayLength));
    bool isMetal = isLookedAtAsMetal(material);
    if (hasDielectric && isGlass(material) && !isMetal) {
        if (scatterSmoothDielectric(slot, surface, materialIndex))
            weaken(slot, glassTint(material));
    } else if (isThinGlass(material) && !isMetal) {
        scatterThinGlass(slot, surface, material);
    } else {
        float cosine = abs(dotProduct(direction, surface.normal));
        weaken(slot, isMixture(material) ? schlickReflectance(cosine, material.albedo, 1.0)
                                         : mirrorReflectance(material, cosine));
        reflectRay(slot, surface, surface.normal);
    }
    return true;
}

// What a path that has left the scene shows: a normal has no length.
vec3 ofNothing() {
    if (looksThrough && view == viewNormal)
        return normalColour(vec3(0.0));
    return vec3(view == viewOcclusion ? 1.0 : 0.0);
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
        show(slot, ofNothing());
        return;
    }
    uint materialIndex;
    Surface surface = surfaceHit(slot, materialIndex);
    traceEvent(slot, traceSurfacePosition, 0u, surface.position);
    traceEvent(slot, traceSurfaceNormal, 0u, surface.normal);
    if (looksThrough) {
        if (hasDielectric)
            weaken(slot, transmittance(slot, path[slot].rayLength));
        if (lookThrough(slot, surface, materialIndex))
            return;
        surface = facing(slot, surface);
    }
    if (view == viewNormal)
        show(slot, normalColour(surface.normal));
    if (view == viewDepth)
        show(slot, path[slot].sampleRadiance + vec3(path[slot].rayLength));
    if (view == viewId)
        show(slot, idColour(path[slot].hitPrimitive));
    if (view == viewCoordinates) {
        vec2 uv = hitUvs(hitOf(slot), surface.position).first;
        show(slot, vec3(fractionOf(uv.x), fractionOf(uv.y), 0.0));
    }
    if (view == viewAlbedo) {
        MaterialRecord material =
            hitMaterial(hitOf(slot), fetchMaterial(materialIndex), texturesBaseColour, surface.position);
        vec3 colour = isColourless(material) ? vec3(1.0) : material.albedo;
        show(slot, looksThrough ? withoutTiny(path[slot].throughput * colour) : colour);
    }
    if (view == viewShadow && catchesShadows(fetchMaterial(materialIndex)))
        catchShadow(slot, facing(slot, surface));
    if (view >= viewObject)
        show(slot, vec3(floatOf(numberOf(view, path[slot].hitPrimitive, materialIndex))));
    if (view == viewOcclusion)
        setSurface(slot, facing(slot, surface));
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
    while (hasSegments && !regeneratesPaths && isAtStageUpTo(stageClosest) && stepsTaken < dispatch.stepBudget);
    if (view == viewOcclusion)
        lightSurfaces();
}

void main() { integrate(); }
