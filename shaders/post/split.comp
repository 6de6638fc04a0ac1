// First pass of the denoiser: the means of the two halves of the samples, without fireflies.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"

void main() {
    if (!beginPass())
        return;
    int place = placeOf(own);
    float sum = 0.0;
    vec3 largest = vec3(0.0);
    [[unroll]] for (int dy = -fireflyRadius; dy <= fireflyRadius; ++dy)
        [[unroll]] for (int dx = -fireflyRadius; dx <= fireflyRadius; ++dx) {
            if (dx == 0 && dy == 0)
                continue;
            float neighbour = luminance(noisyVector(placeOf(own + ivec2(dx, dy)), 0));
            sum += neighbour;
            largest = withLargest(largest, neighbour);
        }
    vec3 colour = noisyVector(place, 0);
    vec3 variance = noisyVector(place, 2);
    float firstShare = noisyNumber(place, 0);
    float secondShare = 1.0 - firstShare;
    vec3 first = noisyVector(place, 1);
    vec3 second = (colour - firstShare * first) * divide(1.0, secondShare);
    float apart = luminance(first - second);
    float factor =
        fireflyFactor(luminance(colour), apart * apart * (firstShare * secondShare), sum, largest);
    first = first * factor;
    second = second * factor;
    vec3 difference = first - second;
    storeVector(splitTexels, place * splitRows, first);
    storeVector(splitTexels, place * splitRows + 1, second);
    storeVector(splitTexels, place * splitRows + 2, variance * (factor * factor));
    storeVector(splitTexels, place * splitRows + 3, difference * difference * (firstShare * secondShare));
}
