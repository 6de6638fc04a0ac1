// Eighth pass of the denoiser: how many pixels of the neighbourhood have chosen each estimate.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"

void main() {
    if (!beginPass())
        return;
    uvec4 counts = uvec4(0u);
    for (int dy = -choiceRadius; dy <= choiceRadius; ++dy)
        [[unroll]] for (int dx = -choiceRadius; dx <= choiceRadius; ++dx) {
            uint choice = imageLoad(choiceTexels, placeOf(own + ivec2(dx, dy))).x;
            [[unroll]] for (int i = 0; i < estimateCount; ++i)
                counts[i] += choice == uint(i) ? 1u : 0u;
        }
    imageStore(countTexels, placeOf(own), counts);
}
