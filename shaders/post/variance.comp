// Second pass of the denoiser: the variance of each pixel's mean, as the halves show it around the pixel.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"

void main() {
    if (!beginPass())
        return;
    int place = placeOf(own);
    vec3 squares = vec3(0.0);
    vec3 variance = vec3(0.0);
    for (int dy = -varianceRadius; dy <= varianceRadius; ++dy)
        [[unroll]] for (int dx = -varianceRadius; dx <= varianceRadius; ++dx) {
            int other = placeOf(own + ivec2(dx, dy)) * splitRows;
            squares += loadVector(splitTexels, other + 3);
            variance += loadVector(splitTexels, other + 2);
        }
    vec3 ratio = vec3(varianceRatio(squares.x, variance.x), varianceRatio(squares.y, variance.y),
                      varianceRatio(squares.z, variance.z));
    storeVector(varianceTexels, place, loadVector(splitTexels, place * splitRows + 2) * ratio + 1e-10);
}
