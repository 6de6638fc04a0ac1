// Sixth pass of the denoiser: estimates of a pixel's colour. By each fit it is the mean of what the models of the four
// nearest anchors say of the pixel, weighted by how near and how alike they are; a little of its own colour is there
// for a pixel that none of them is like.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"
#include "shaders/post/level.glsl"

// A model's colour for the features. Radiance is not negative.
vec3 colourBy(int model, const float features[featureCount]) {
    vec4 rows[modelRows];
    [[unroll]] for (int m = 0; m < modelRows; ++m)
        rows[m] = loadTexel(modelTexels, model + m);
    vec3 colour = rows[0].xyz;
    [[unroll]] for (int m = 1; m < modelRows; ++m)
        colour += features[m] * rows[m].xyz;
    [[unroll]] for (int m = 0; m < modelRows; m += 3)
        colour += features[modelRows + m / 3] * vec3(rows[m].w, rows[m + 1].w, rows[m + 2].w);
    return greater(colour, vec3(0.0));
}

void main() {
    if (!beginPass())
        return;
    int place = placeOf(own);
    LevelPixel pixel = loadLevel(place * levelRows);
    float firstShare = pixel.firstShare;
    float secondShare = 1.0 - firstShare;
    vec3 noisy = pixel.first * firstShare + pixel.second * secondShare;
    float limit = errorLimit(luminance(noisy), luminance(loadVector(splitTexels, place * splitRows + 2)));
    vec2 factors = factorsOf(pixel);
    float features[featureCount];
    vec3 wide;
    for (int fit = 0; fit < fitCount; ++fit) {
        ivec2 size = levelSizeOf(fit);
        ivec2 anchors = anchorsOf(size);
        int step = anchorStep(fit);
        ivec2 along = own - firstAnchor(fit) + step; // from the anchor before the tile
        ivec2 before = along / step - 1;
        vec2 beyond = vec2(along % step) * divide(1.0, float(step));
        vec2 weights = vec2(ownWeight); // of both halves
        vec3 first = pixel.first * ownWeight;
        vec3 second = pixel.second * ownWeight;
        for (int i = 0; i < 4; ++i) {
            ivec2 side = ivec2(i & 1, i >> 1);
            ivec2 anchor = clamp(before + side, ivec2(0), anchors - 1);
            LevelPixel other = loadLevel(placeInLevel(pixelOfAnchor(anchor, size), size, fit));
            float nearness = (side.x == 1 ? beyond.x : 1.0 - beyond.x) * (side.y == 1 ? beyond.y : 1.0 - beyond.y);
            vec2 distances = sharpnessOf(fit) * distancesOf(pixel, other, factors);
            vec2 weight = nearness * vec2(weightOf(distances.y), weightOf(distances.x));
            featuresOf(pixel, other, features);
            int model = placeOfModel(anchor, anchors, fit);
            weights += weight;
            first += weight.x * colourBy(model, features);
            second += weight.y * colourBy(model + modelRows, features);
        }
        first = first * divide(1.0, weights.x);
        second = second * divide(1.0, weights.y);
        vec3 estimate = first * firstShare + second * secondShare;
        vec3 difference = first - second;
        if (fit == fitWide)
            wide = estimate;
        storeWithNumber(estimateTexels, place * estimateCount + fit, estimate,
                        relativeError(estimate, pixel.first, pixel.second,
                                      difference * difference * (firstShare * secondShare), wide, limit));
    }
    // Of the noisy colour itself: the first term of its error is 0, and the variance is that of the whole.
    vec3 squares = loadVector(splitTexels, place * splitRows + 3);
    storeWithNumber(estimateTexels, place * estimateCount + estimateNoisy, noisy,
                    relativeError(noisy, noisy, pixel.second, squares * 0.5, wide, limit));
}
