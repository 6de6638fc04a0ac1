// Last pass of the denoiser: the estimates of a pixel, by the shares of the neighbourhood that has chosen them;
// pixels without noise stay as they are.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"

void main() {
    if (!beginPass())
        return;
    float counts[estimateCount];
    [[unroll]] for (int i = 0; i < estimateCount; ++i)
        counts[i] = 0.0;
    for (int dy = -choiceRadius; dy <= choiceRadius; ++dy)
        [[unroll]] for (int dx = -choiceRadius; dx <= choiceRadius; ++dx) {
            uint choice = imageLoad(choiceTexels, placeOf(own + ivec2(dx, dy))).x;
            [[unroll]] for (int i = 0; i < estimateCount; ++i)
                counts[i] += choice == uint(i) ? 1.0 : 0.0;
        }
    int place = placeOf(own);
    vec3 sum = vec3(0.0);
    [[unroll]] for (int i = 0; i < estimateCount; ++i)
        sum += loadVector(estimateTexels, place * estimateCount + i) * counts[i];
    vec3 noisy = loadVector(estimateTexels, place * estimateCount + estimateNoisy);
    vec3 blended = greater(sum * (1.0 / 25.0), vec3(0.0));
    int level = place * levelRows;
    float firstShare = loadNumber(levelTexels, level + levelFirst);
    vec3 around = loadVector(levelTexels, level + levelGuides) * firstShare +
                  loadVector(levelTexels, level + levelGuides + 1) * (1.0 - firstShare);
    bool isNoisy = !isCertain(noisy, loadVector(splitTexels, place * splitRows + 2), around);
    storeVector(denoisedTexels, place, isNoisy ? blended : noisy);
}
