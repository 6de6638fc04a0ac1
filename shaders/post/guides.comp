// Third pass of the denoiser: what weights are made of, means of the halves over 3 x 3 pixels with their variance.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"

void main() {
    if (!beginPass())
        return;
    vec3 first = vec3(0.0);
    vec3 second = vec3(0.0);
    vec3 variance = vec3(0.0);
    [[unroll]] for (int dy = -guideRadius; dy <= guideRadius; ++dy)
        [[unroll]] for (int dx = -guideRadius; dx <= guideRadius; ++dx) {
            int other = placeOf(own + ivec2(dx, dy));
            first += loadVector(splitTexels, other * splitRows);
            second += loadVector(splitTexels, other * splitRows + 1);
            variance += loadVector(varianceTexels, other);
        }
    int place = placeOf(own) * guideRows;
    storeVector(guideTexels, place, first * (1.0 / 9.0));
    storeVector(guideTexels, place + 1, second * (1.0 / 9.0));
    storeVector(guideTexels, place + 2, variance * (1.0 / 81.0));
}
