// Third pass of the denoiser: the fine level. Weights are made of means of the halves over 3 x 3 pixels, with their
// variance, and of those of the pixel.
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
    int place = placeOf(own);
    int level = place * levelRows;
    storeWithNumber(levelTexels, level + levelFirst, loadVector(splitTexels, place * splitRows), noisyNumber(place, 0));
    storeVector(levelTexels, level + levelSecond, loadVector(splitTexels, place * splitRows + 1));
    storeVector(levelTexels, level + levelVariance, loadVector(varianceTexels, place));
    storeVector(levelTexels, level + levelGuides, first * (1.0 / 9.0));
    storeVector(levelTexels, level + levelGuides + 1, second * (1.0 / 9.0));
    storeVector(levelTexels, level + levelGuides + 2, variance * (1.0 / 81.0));
    storeWithNumber(levelTexels, level + levelAlbedo, noisyVector(place, 3), noisyNumber(place, 1));
    storeVector(levelTexels, level + levelNormal, noisyVector(place, 4));
}
