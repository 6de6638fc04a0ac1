// Entry kernel: rays from a buffer through the tree, with nothing around, to measure traversal by itself. RAYS rays an
// invocation, Triangles only.
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
#include "shaders/memory/lanes.glsl"
#include "shaders/integrators/path_slots.glsl"
#include "shaders/traversal/meet_triangle.glsl"
#include "shaders/traversal/traverse.glsl"

layout(constant_id = constantIsAnyHit) const bool isAnyHit = false;

// As in scene_data.glsl: texels where lavapipe reads them. It writes to storage buffers faster, by whole rows.
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

// The ray's slot is its index: where it is in path_slots.glsl, and in the same order of workgroups.
void beginRay(uint slot) {
    uvec2 part = divideSmall(gl_WorkGroupID.x, divideSmall(gl_NumWorkGroups.x, dispatch.interleave).x);
    uint group = part.y * dispatch.interleave + part.x;
    uint lanes = group * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    slotIndex[slot] = (lanes >> 3u) * (8u * RAYS) + slot * 8u + (lanes & 7u);
    isSlotUsed[slot] = slotIndex[slot] < slotCount();
    RayRecord ray = fetchRay(isSlotUsed[slot] ? slotIndex[slot] : 0u);
    path[slot].rayOrigin = ray.origin;
    path[slot].rayDirection = ray.direction;
    path[slot].rayLength = ray.maxDistance;
    path[slot].rayExcluded = ray.excluded;
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
    // Neither a spent budget nor lavapipe's own limit, which ends loops in silence, is mistaken for an answer.
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
