// Views of what primary rays meet, and ambient occlusion. Twin: host/reference/view.h.
//
// Ambient occlusion is the share of a white sky that a point sees, weighted by the cosine to its normal, with
// everything further away than `occlusionDistance` left out: Zhukov, Iones and Kronin, "An Ambient Light Illumination
// Model", 1998.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"

const bool lightPassesGlass = false;
const bool raysHaveTargets = false;
const bool hasBounces = false;

#include "shaders/kernels/stages.glsl"

layout(constant_id = constantView) const uint view = viewNormal;

void beginSample(uint slot) { sendPrimaryRay(slot); }

void show(uint slot, vec3 value) {
    if (!showsCost)
        path[slot].sampleRadiance = value;
    traceEvent(slot, traceRadiance, 0u, value);
}

// Stage: the nearest hit is known.
void shadeHit(uint slot) {
    traceNearestHit(slot);
    path[slot].stage = stageSampleDone;
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
    traceRays();
    if (view == viewOcclusion)
        lightSurfaces();
}

void main() { integrate(); }
