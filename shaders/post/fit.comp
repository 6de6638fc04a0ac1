// Fifth pass of the denoiser, once for each fit: colours as linear functions of features, by a regression over the
// neighbours of an anchor. Each half of the samples is fitted by weights that come from the other one, so that its
// noise does not choose.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"
#include "shaders/post/level.glsl"
#include "shaders/post/moments.glsl"

void store(int place, const Moments solved) {
    [[unroll]] for (int m = 0; m < modelRows; ++m)
        storeWithNumber(modelTexels, place + m, solved.sums[m], solved.sums[modelRows + m / 3][m % 3]);
}

void main() {
    readTileSize();
    int fit = int(dispatchConstants.fit);
    ivec2 size = levelSizeOf(fit);
    ivec2 anchors = anchorsOf(size);
    if (!beginPassOver(anchors))
        return;
    ivec2 pixel = pixelOfAnchor(own, size);
    LevelPixel anchor = loadLevel(placeInLevel(pixel, size, fit));
    vec2 factors = factorsOf(anchor);
    int radius = fitRadius(fit);
    float sharpness = sharpnessOf(fit);
    float features[featureCount];
    Moments firsts = noMoments();
    Moments seconds = noMoments();
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
            ivec2 place = pixel + ivec2(dx, dy);
            bool isInside = place.x >= 0 && place.x < size.x && place.y >= 0 && place.y < size.y;
            LevelPixel other = loadLevel(placeInLevel(clamp(place, ivec2(0), size - 1), size, fit));
            featuresOf(other, anchor, features);
            vec2 distances = sharpness * distancesOf(other, anchor, factors);
            add(firsts, isInside ? weightOf(distances.y) : 0.0, features, other.first);
            add(seconds, isInside ? weightOf(distances.x) : 0.0, features, other.second);
        }
    solve(firsts);
    solve(seconds);
    int place = placeOfModel(own, anchors, fit);
    store(place, firsts);
    store(place + modelRows, seconds);
}
