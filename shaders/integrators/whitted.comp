// The classic integrator: direct light with shadows on diffuse surfaces, both branches at glass, all of it
// deterministic. Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980.
// Twin: host/reference/whitted.h, where the same happens ray by ray.
//
// A path slot works through the samples of one pixel and, for each of them, through the tree of rays that glass splits
// it into.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

const bool lightPassesGlass = hasDielectric;
const bool raysHaveTargets = false;
const bool hasBounces = false;

#include "shaders/kernels/stages.glsl"
#include "shaders/integrators/pending_rays.glsl"

void beginSample(uint slot) {
    beginInMedia(slot);
    beginTransparency(slot);
}

// Ends a path; the sample may have another one pending.
void endPath(uint slot) {
    path[slot].stage = hasDielectric && path[slot].pendingCount > 0u ? stageNextRay : stageSampleDone;
}

// Stage: take the pending ray.
void takePendingRay(uint slot) {
    PendingRay ray = popPendingRay(slot);
    endSeeingThrough(slot); // it was reflected
    path[slot].throughput = ray.throughput;
    startRay(slot, ray.origin, ray.direction, ray.excluded, ray.depth, ray.medium);
}

void reflectRay(uint slot, Surface surface, uint medium) {
    vec3 direction = mirrorDirection(path[slot].rayDirection, surface.normal);
    vec3 origin = offsetRayOrigin(surface, direction);
    endSeeingThrough(slot);
    startRay(slot, origin, direction, path[slot].hitPrimitive, path[slot].rayDepth + 1u, medium);
    rayCounts[slot].z += 1u;
}

PendingRay reflectedRay(uint slot, Surface surface, float reflectance, uint medium) {
    PendingRay reflected;
    reflected.direction = mirrorDirection(path[slot].rayDirection, surface.normal);
    reflected.origin = offsetRayOrigin(surface, reflected.direction);
    reflected.excluded = path[slot].hitPrimitive;
    reflected.depth = path[slot].rayDepth + 1u;
    reflected.medium = medium;
    reflected.throughput = path[slot].throughput * reflectance;
    return reflected;
}

// Each branch makes its own ray. A branch that only copies would become selections, which lavapipe merges a second time
// under the mask of the enclosing loop; it computes common parts of the branches once.
void pushReflectedRay(uint slot, Surface surface, float reflectance, uint medium) {
    uint level = path[slot].pendingCount;
    path[slot].pendingCount = level + 1u;
    if (pendingInRegisters == 0u)
        storePendingRay(level * slotCount() + slotIndex[slot], reflectedRay(slot, surface, reflectance, medium));
    [[unroll]] for (uint i = 0u; i < pendingInRegisters; ++i)
        if (i == level)
            pendingLevels[slot][i] = reflectedRay(slot, surface, reflectance, medium);
}

void splitAtGlass(uint slot, Surface surface, MaterialRecord material, uint materialIndex, bool isEntering) {
    vec3 direction = path[slot].rayDirection;
    vec3 facing = isEntering ? surface.normal : -surface.normal;
    Refraction refraction = refractRay(direction, facing, material.refractiveIndex, isEntering);
    traceEvent(slot, traceReflectance, refraction.isTotal ? 1u : 0u, vec3(refraction.reflectance));
    uint mediumOfReflection = isEntering ? path[slot].rayMedium : materialIndex;
    if (refraction.isTotal) {
        reflectRay(slot, surface, mediumOfReflection);
        return;
    }
    // The reflected ray waits; the path continues with the refracted one.
    pushReflectedRay(slot, surface, refraction.reflectance, mediumOfReflection);
    rayCounts[slot].z += 1u;

    path[slot].throughput = path[slot].throughput * refraction.transmittance;
    vec3 origin = offsetRayOrigin(surface, refraction.direction);
    startRay(slot, origin, refraction.direction, path[slot].hitPrimitive, path[slot].rayDepth + 1u,
             isEntering ? materialIndex : noMaterial);
    rayCounts[slot].w += 1u;
}

// Radiance of rays that leave the scene.
vec3 radianceAround(vec3 direction) {
    if ((lighting & lightsByEnvironment) != 0u)
        return environmentRadianceAt(environmentPlace(direction));
    return frame.background;
}

void leaveScene(uint slot, vec3 tint) {
    if (seesThrough(slot))
        becomeTransparent(slot, path[slot].throughput * tint);
    else if (!showsCost)
        path[slot].sampleRadiance = path[slot].sampleRadiance + withoutTiny(path[slot].throughput * tint) *
                                                                    radianceAround(path[slot].rayDirection);
    traceEvent(slot, traceRadiance, 0u, path[slot].sampleRadiance);
    endPath(slot);
}

// Stage: the nearest hit is known.
void shadeHit(uint slot) {
    traceNearestHit(slot);
    // Tint of the glass that the ray was in, fetched once.
    vec3 tint = vec3(1.0);
    if (hasDielectric && path[slot].rayMedium != noMaterial)
        tint = fetchMaterial(path[slot].rayMedium).segmentTint;
    if (path[slot].hitPrimitive == noPrimitive) {
        leaveScene(slot, tint);
        return;
    }
    uint materialIndex;
    Surface surface = surfaceHit(slot, materialIndex);
    MaterialRecord material =
        hitMaterial(hitOf(slot), fetchMaterial(materialIndex), texturesBaseColour | texturesEmission, surface.position);
    vec3 direction = path[slot].rayDirection;
    bool isEntering = dotProduct(direction, surface.normal) < 0.0;
    bool isClear = hasDielectric && isGlassForWhitted(material);
    if (hasDielectric)
        path[slot].throughput =
            withoutTiny(path[slot].throughput * (isClear && !isEntering ? material.segmentTint : tint));
    traceEvent(slot, traceSurfacePosition, 0u, surface.position);
    traceEvent(slot, traceSurfaceNormal, 0u, surface.normal);
    traceEvent(slot, traceThroughput, 0u, path[slot].throughput);
    if (seesThrough(slot) && catchesShadows(material)) {
        becomeTransparent(slot, path[slot].throughput);
        endPath(slot);
        return;
    }
    if (alphaKind == alphaOfBackground)
        endSeeingThrough(slot);
    if (showsBaseColour(material)) {
        if (!showsCost)
            path[slot].sampleRadiance = path[slot].sampleRadiance + path[slot].throughput * material.albedo;
        traceEvent(slot, traceRadiance, 0u, path[slot].sampleRadiance);
        endPath(slot);
        return;
    }
    bool isSeenFromFront = dotProduct(direction, surface.geometricNormal) < 0.0;
    if (hasEmission && !showsCost && (isSeenFromFront || emitsBehind(material))) {
        path[slot].sampleRadiance = path[slot].sampleRadiance + path[slot].throughput * material.emission;
        traceEvent(slot, traceRadiance, 0u, path[slot].sampleRadiance);
    }
    endPath(slot);
    if (!hasSpecular || isDiffuseForWhitted(material)) {
        if (isTwoSided(material) && dotProduct(direction, surface.geometricNormal) > 0.0) {
            surface.normal = -surface.normal;
            surface.geometricNormal = -surface.geometricNormal;
        }
        setSurface(slot, surface);
        path[slot].surfaceWeight = path[slot].throughput * (material.albedo * inversePi);
        path[slot].lightIndex = 0u;
    } else if (path[slot].rayDepth < frame.maxDepth) {
        if (isClear) {
            splitAtGlass(slot, surface, material, materialIndex, isEntering);
        } else {
            path[slot].throughput = withoutTiny(path[slot].throughput * mirrorReflectanceForWhitted(material));
            reflectRay(slot, surface, path[slot].rayMedium);
        }
    }
}

// Stage: send a shadow ray to the next light, if it is on the front side of the surface.
void sampleDirectLight(uint slot) {
    if (path[slot].lightIndex == lightCount) {
        endPath(slot);
        return;
    }
    LightRecord light = lightAt(path[slot].lightIndex);
    vec3 toLight = light.position - path[slot].surfacePosition;
    float distance = vectorLength(toLight);
    vec3 direction = toLight * divide(1.0, distance);
    if ((lighting & lightsByDirections) != 0u && light.kind == lightDirectional) {
        distance = unbounded;
        direction = -light.axis;
    }
    bool isLit = dotProduct(path[slot].surfaceNormal, direction) > 0.0 &&
                 dotProduct(surfaceAt(slot).geometricNormal, direction) > 0.0;
    if (!isLit) {
        traceEvent(slot, traceVisibility, visibilityUnlit, vec3(path[slot].lightIndex));
        path[slot].lightIndex += 1u;
        if (path[slot].lightIndex == lightCount)
            endPath(slot);
        return;
    }
    beginShadow(slot, direction, distance);
}

// Stage: the shadow ray has arrived, or was stopped.
void addLight(uint slot) {
    bool isVisible = path[slot].hitPrimitive == noPrimitive;
    bool isDimmed = hasDielectric && path[slot].isLightDimmed != 0u;
    traceEvent(slot, traceVisibility, isVisible ? (isDimmed ? visibilityDimmed : visibilityClear) : visibilityBlocked,
               vec3(path[slot].lightIndex));
    if (isVisible && !showsCost) {
        LightRecord light = lightAt(path[slot].lightIndex);
        float squaredDistance = path[slot].rayLength * path[slot].rayLength;
        float cosine = dotProduct(path[slot].surfaceNormal, path[slot].rayDirection);
        bool isDirectional = (lighting & lightsByDirections) != 0u && light.kind == lightDirectional;
        vec3 irradiance = light.intensity * (isDirectional ? cosine : divide(cosine, squaredDistance));
        if ((lighting & lightsBySpots) != 0u && light.kind == lightSpot)
            irradiance *= spotFalloff(path[slot].rayDirection, light.axis, light.cosineOuter, light.falloffScale);
        vec3 reflected = path[slot].surfaceWeight * irradiance;
        if (isDimmed)
            reflected *= frame.shadowThroughGlass;
        path[slot].sampleRadiance = path[slot].sampleRadiance + reflected;
        traceEvent(slot, traceRadiance, 0u, path[slot].sampleRadiance);
    }
    path[slot].lightIndex += 1u;
    path[slot].stage = stageNextLight;
    if (path[slot].lightIndex == lightCount)
        endPath(slot);
}

// Follows rays until they hit a diffuse surface or leave the scene.
void followPaths() {
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        if (hasDielectric && path[slot].stage == stageNextRay)
            takePendingRay(slot);
    traceRays();
}

void advancePaths() {
    bool takesOnePass = !hasSpecular && lightCount <= 1u; // no loop is needed
    do {
        do
            followPaths();
        while (hasSpecular && isAtStageUpTo(stageClosest) && stepsTaken < dispatch.stepBudget);
        lightSurfaces();
        stepsTaken += 1u;
    } while (!takesOnePass && isAtStageUpTo(stageShadow) && stepsTaken < dispatch.stepBudget);
}

void main() { integrate(); }
