// Entry kernel of the tests of functions: calls one of them for each input. Inputs and outputs are words, in the order
// of the function's parameters and of the fields of structs. The probes of leaf functions are made from their
// signatures (cmake/glsl_probes.cpp).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#define MEMORY_TEXELS 0
#define TRAVERSAL_SKIP_LIST 0
#define TRAVERSAL_RAY_QUERY 0
#define TREE_WIDE 0
#include "shaders/layout/layout.h"
#include "shaders/layout/buffers.h"
#include "tests/kernels/probe_layout.h"

layout(local_size_x_id = 0) in;

#include "shaders/memory/bindings.glsl"
#include "shaders/memory/scene_data.glsl"
#include "shaders/math/arithmetic.glsl"
#include "shaders/leaves.glsl"

layout(set = 0, binding = bindingProbeInputs, std430) readonly buffer InputBuffer { uint inputWords[]; };
layout(set = 0, binding = bindingProbeOutputs, std430) writeonly buffer OutputBuffer { uint outputWords[]; };

layout(constant_id = constantProbedFunction) const uint probedFunction = 0u;
layout(constant_id = constantInputWords) const uint inputWordCount = 1u;
layout(constant_id = constantOutputWords) const uint outputWordCount = 1u;

uint inputCursor;
uint outputCursor;

uint takeUint() { return inputWords[inputCursor++]; }

bool takeBool() { return takeUint() != 0u; }

float takeFloat() { return uintBitsToFloat(takeUint()); }

uvec2 takeUvec2() {
    uint x = takeUint();
    return uvec2(x, takeUint());
}

uvec3 takeUvec3() {
    uvec2 xy = takeUvec2();
    return uvec3(xy, takeUint());
}

uvec4 takeUvec4() {
    uvec3 xyz = takeUvec3();
    return uvec4(xyz, takeUint());
}

vec2 takeVec2() { return uintBitsToFloat(takeUvec2()); }

vec3 takeVec3() { return uintBitsToFloat(takeUvec3()); }

vec4 takeVec4() { return uintBitsToFloat(takeUvec4()); }

void give(uint value) { outputWords[outputCursor++] = value; }

void give(bool value) { give(value ? 1u : 0u); }

void give(uvec2 value) {
    give(value.x);
    give(value.y);
}

void give(uvec3 value) {
    give(value.xy);
    give(value.z);
}

void give(uvec4 value) {
    give(value.xyz);
    give(value.w);
}

void give(float value) { give(floatBitsToUint(value)); }

void give(vec2 value) { give(floatBitsToUint(value)); }

void give(vec3 value) { give(floatBitsToUint(value)); }

void give(vec4 value) { give(floatBitsToUint(value)); }

#include "leaf_probes.glsl"

void main() {
    loadConstants();
    inputCursor = gl_GlobalInvocationID.x * inputWordCount;
    outputCursor = gl_GlobalInvocationID.x * outputWordCount;
    if (probedFunction == probedQuotient) {
        float a = takeFloat();
        give(divide(a, takeFloat()));
    }
    if (probedFunction == probedRoot)
        give(squareRoot(takeFloat()));
    probeLeaf();
}
