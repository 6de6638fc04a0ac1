// The contract of trace_rays.comp beside layout.h: rays in a buffer, and what they hit. Compiled as C++ and as GLSL.
#ifndef HYALITE_RAY_RECORDS_H
#define HYALITE_RAY_RECORDS_H

#ifdef __cplusplus
#include "shaders/layout/buffers.h"

namespace hyalite::core::layout {
#endif

struct RayRecord {
    vec3 origin;
    float maxDistance; // hits at this distance and beyond do not count
    vec3 direction;    // unit length
    uint excluded;     // the primitive that the ray starts on, or noPrimitive
};

struct HitRecord {
    uint primitive; // its id, or noPrimitive; of any hit: hitAnything or noPrimitive
    float distance; // 0 unless the nearest hit is there and wanted, and so are the weights
    float u;        // weights of the triangle's first and second vertex
    float v;
};

const uint hitAnything = 0u;
const uint hitUnknown = 0xFFFFFFFEu; // instead of a primitive: the ray was not followed to its end

// Bindings and specialization constants that follow those of layout.h.
const uint bindingRays = bindingCount;
const uint bindingHits = bindingCount + 1u;
const uint rayBindingCount = bindingCount + 2u;
const uint constantIsAnyHit = constantCount; // 1: whether anything is hit; 0: the nearest hit
const uint rayConstantCount = constantCount + 1u;

#ifdef __cplusplus
static_assert(sizeof(RayRecord) == 32 && offsetof(RayRecord, direction) == 16);
static_assert(sizeof(HitRecord) == 16);
} // namespace hyalite::core::layout
#endif
#endif
