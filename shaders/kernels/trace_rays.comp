// Entry kernel: traces rays from a buffer, to measure traversal alone. RAYS rays an invocation; triangles only.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"
#include "shaders/layout/ray_records.h"

const bool lightPassesGlass = hasDielectric;
const bool raysHaveTargets = false;
const bool hasBounces = false;

#include "shaders/memory/scene_data.glsl"
#include "shaders/math/arithmetic.glsl"
#include "shaders/leaves.glsl"
#include "shaders/trace/preloaded.glsl"
#include "shaders/drive/lanes.glsl"
#include "shaders/drive/slots.glsl"
#include "shaders/trace/any_hit.glsl"
#include "shaders/trace/trace.glsl"

layout(constant_id = constantIsAnyHit) const bool isAnyHit = false;

// Rays are read from texels where the scene is (scene_data.glsl). Hits go to a storage buffer: lavapipe writes those
// faster, by whole rows.
#if MEMORY_TEXELS

layout(set = 0, binding = bindingRays, rgba32ui) uniform restrict readonly uimageBuffer rayTexels;

RayRecord fetchRay(uint index) {
    uvec4 a = imageLoad(rayTexels, int(index) * 2);
    uvec4 b = imageLoad(rayTexels, int(index) * 2 + 1);
    return RayRecord(uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), b.w);
}

#else

layout(set = 0, binding = bindingRays, std430) restrict readonly buffer RayBuffer { RayRecord rays[]; };

RayRecord fetchRay(uint index) { return rays[index]; }

#endif

layout(set = 0, binding = bindingHits, std430) restrict writeonly buffer HitBuffer { uvec4 hitRows[]; };

void storeHit(uint index, HitRecord hit) {
    hitRows[index] = uvec4(hit.primitive, floatBitsToUint(vec3(hit.distance, hit.u, hit.v)));
}

// The slot of a ray is its index; workgroups are in the same order as in shaders/drive/slots.glsl.
void beginRay(uint slot) {
    uint lanes = blockOfWorkgroup() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    slotIndex[slot] = (lanes >> 3u) * (8u * RAYS) + slot * 8u + (lanes & 7u);
    isSlotUsed[slot] = slotIndex[slot] < slotCount();
    RayRecord ray = fetchRay(isSlotUsed[slot] ? slotIndex[slot] : 0u);
    path[slot].rayOrigin = ray.origin;
    path[slot].rayDirection = ray.direction;
    path[slot].rayLength = ray.maxDistance;
    path[slot].rayExcluded = ray.excluded;
    path[slot].rayDepth = 1u; // with the next two: decides about alpha-tested surfaces
    path[slot].sampleIndex = 0u;
    imagePixel[slot] = uvec2(0u);
    path[slot].hitPrimitive = noPrimitive;
    path[slot].hitU = 0.0;
    path[slot].hitV = 0.0;
    path[slot].isLightDimmed = 0u;
    path[slot].stackSize = 0u;
    if (isSlotUsed[slot]) {
        path[slot].stage = isAnyHit ? stageShadow : stageClosest;
        enterTree(slot);
    } else {
        path[slot].stage = stageDone;
        stopTraversal(slot);
    }
}

void endRay(uint slot) {
    if (!isSlotUsed[slot])
        return;
    bool isHit = path[slot].hitPrimitive != noPrimitive;
    HitRecord hit = HitRecord(noPrimitive, 0.0, 0.0, 0.0);
    if (isHit && isAnyHit)
        hit.primitive = hitAnything;
    else if (isHit)
        hit = HitRecord(path[slot].hitPrimitive, path[slot].rayLength, path[slot].hitU, path[slot].hitV);
    // An unfinished ray is marked: its budget is spent, or lavapipe has ended the loop silently at its own limit.
    if (isTraversing(slot) || stackOverflowCount != 0u)
        hit.primitive = hitUnknown;
    storeHit(slotIndex[slot], hit);
}

void main() {
    loadConstants();
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        beginRay(slot);
    if (isAnyHit)
        traverse(stageShadow, true);
    else
        traverse(stageClosest, false);
    [[unroll]] for (uint slot = 0u; slot < RAYS; ++slot)
        endRay(slot);
}
