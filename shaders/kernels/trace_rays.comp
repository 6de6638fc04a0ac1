// Entry kernel: traces rays from a buffer, to measure traversal alone. RAYS rays an invocation; triangles only.
#version 450
#extension GL_GOOGLE_include_directive : require

#include "shaders/kernels/begin_kernel.glsl"
#include "shaders/layout/ray_records.h"

const bool lightPassesGlass = hasDielectric;
const bool raysHaveTargets = false;

#include "shaders/memory/scene_data.glsl"
#include "shaders/memory/counters.glsl"
#include "shaders/math/arithmetic.glsl"
#include "shaders/leaves.glsl"
#include "shaders/trace/preloaded.glsl"
#include "shaders/trace/ray.glsl"
#include "shaders/trace/trace.glsl"
#include "shaders/drive/lanes.glsl"
#include "shaders/drive/places.glsl"

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

bool takesPart[RAYS];

// A ray's place is its index; workgroups are in the same order as in shaders/drive/places.glsl.
void beginRay(uint i) {
    uint lanes = blockOfWorkgroup() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    uint index = (lanes >> 3u) * (8u * RAYS) + i * 8u + (lanes & 7u);
    slotIndex[i] = index;
    takesPart[i] = index < pathCount();
    RayRecord ray = fetchRay(takesPart[i] ? index : 0u);
    traversal[i].ray = Ray(ray.origin, ray.maxDistance, ray.direction, ray.excluded, noPrimitive);
    traversal[i].key = RayKey(uvec2(0u), 0u, isAnyHit ? 3u : 2u);
    traversal[i].hit = Hit(ray.maxDistance, noPrimitive, noPrimitive, 0.0, 0.0, noInstance);
    traversal[i].isDimmed = false;
    traversal[i].stackIndex = index;
    traversal[i].stackSize = 0u;
    if (takesPart[i])
        enterTree(i);
    else
        stopTraversal(i);
}

void endRay(uint i) {
    if (!takesPart[i])
        return;
    Hit found = traversal[i].hit;
    bool isHit = found.primitive != noPrimitive;
    HitRecord hit = HitRecord(noPrimitive, 0.0, 0.0, 0.0);
    if (isHit && isAnyHit)
        hit.primitive = hitAnything;
    else if (isHit)
        hit = HitRecord(found.primitive, found.distance, found.u, found.v);
    // An unfinished ray is marked: its budget is spent, or lavapipe has ended the loop silently at its own limit.
    if (isTraversing(i) || stackOverflowCount != 0u)
        hit.primitive = hitUnknown;
    storeHit(slotIndex[i], hit);
}

void main() {
    loadConstants();
    EACH_RAY(i, beginRay(i);)
    if (isAnyHit)
        advance(takesPart, true);
    else
        advance(takesPart, false);
    EACH_RAY(i, endRay(i);)
}
