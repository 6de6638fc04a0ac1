// Third pass of the denoiser: the fine level. Weights are made of means of the halves over 3 x 3 pixels, with their
// variance, and of those of the pixel.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"
#include "shaders/post/level.glsl"

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
    LevelPixel pixel;
    pixel.firstShare = noisyNumber(place, 0);
    pixel.first = loadVector(splitTexels, place * splitRows);
    pixel.second = loadVector(splitTexels, place * splitRows + 1);
    pixel.variance = loadVector(varianceTexels, place);
    pixel.firstGuide = first * (1.0 / 9.0);
    pixel.secondGuide = second * (1.0 / 9.0);
    pixel.guideVariance = variance * (1.0 / 81.0);
    pixel.albedo = noisyVector(place, 3);
    pixel.normal = noisyVector(place, 4);
    pixel.depth = noisyNumber(place, 1);
    storeLevel(place * levelRows, pixel);
}
