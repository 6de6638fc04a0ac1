// Entry kernel: lanes of a subgroup exchange values, many times over. The host times it (host/gpu/lane_exchange.cpp).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require

#define LANES_SHUFFLE 1
#include "shaders/layout/layout.h"

layout(local_size_x = 64) in;

layout(constant_id = constantBroadcasts) const bool exchangesByBroadcast = false;
const uint samplesInFlight = 8u;

#include "shaders/drive/lanes.glsl"

layout(set = 0, binding = 0, std430) writeonly buffer ResultBuffer { uint results[]; };

const uint exchanges = 300u;
const uint oneOfSeveral = 0x1010u; // bits: about half of the exchanges find them in all lanes of a pixel

void main() {
    uint mine = gl_LocalInvocationIndex;
    for (uint i = 0u; i < exchanges; ++i) {
        uint values[maxSamplesInFlight];
        exchangeInPixel(mine, values);
        // Each value counts otherwise, and the next exchange waits for all.
        [[unroll]] for (uint lane = 0u; lane < samplesInFlight; ++lane)
            mine = mine * 5u + values[lane];
        mine += isTrueForAllOfPixel((mine & oneOfSeveral) != 0u) ? 1u : 0u;
    }
    results[gl_LocalInvocationIndex] = mine;
}
