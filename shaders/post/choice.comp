// Seventh pass of the denoiser: the estimate with the least error in the neighbourhood, which counts less the further
// it is.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"

void main() {
    if (!beginPass())
        return;
    float errors[estimateCount];
    [[unroll]] for (int i = 0; i < estimateCount; ++i)
        errors[i] = 0.0;
    for (int dy = -errorRadius; dy <= errorRadius; ++dy)
        [[unroll]] for (int dx = -errorRadius; dx <= errorRadius; ++dx) {
            int other = placeOf(own + ivec2(dx, dy)) * estimateCount;
            float weight = float((errorRadius + 1 - abs(dx)) * (errorRadius + 1 - abs(dy)));
            [[unroll]] for (int i = 0; i < estimateCount; ++i)
                errors[i] += weight * loadNumber(estimateTexels, other + i);
        }
    uint choice = 0u;
    float least = errors[0];
    [[unroll]] for (int i = 1; i < estimateCount; ++i) {
        choice = errors[i] < least ? uint(i) : choice;
        least = lesser(errors[i], least);
    }
    imageStore(choiceTexels, placeOf(own), uvec4(choice, 0u, 0u, 0u));
}
