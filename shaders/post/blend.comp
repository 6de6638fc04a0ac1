// Last pass of the denoiser: the estimates of a pixel, by how many of the neighbourhood have chosen them, the noisy
// colour only where many have; pixels without noise stay as they are.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"

void main() {
    if (!beginPass())
        return;
    int place = placeOf(own);
    vec4 weights = vec4(imageLoad(countTexels, place));
    uint count = 0u;
    [[unroll]] for (int dy = -1; dy <= 1; ++dy)
        [[unroll]] for (int dx = -1; dx <= 1; ++dx)
            count += imageLoad(countTexels, placeOf(own + spreadRadius * ivec2(dx, dy)))[estimateNoisy];
    weights[estimateNoisy] *= noisyFactor(float(count));
    vec3 sum = vec3(0.0);
    float total = 0.0;
    [[unroll]] for (int i = 0; i < estimateCount; ++i) {
        sum += loadVector(estimateTexels, place * estimateCount + i) * weights[i];
        total += weights[i];
    }
    vec3 noisy = loadVector(estimateTexels, place * estimateCount + estimateNoisy);
    vec3 blended = greater(sum * divide(1.0, total), vec3(0.0));
    int level = place * levelRows;
    float firstShare = loadNumber(levelTexels, level + levelFirst);
    vec3 around = loadVector(levelTexels, level + levelGuides) * firstShare +
                  loadVector(levelTexels, level + levelGuides + 1) * (1.0 - firstShare);
    bool isNoisy = !isCertain(noisy, loadVector(splitTexels, place * splitRows + 2), around);
    storeVector(denoisedTexels, place, isNoisy ? blended : noisy);
}
