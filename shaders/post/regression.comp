// Fourth pass of the denoiser: estimates of a pixel's colour by a regression over its neighbours, in two bandwidths. Each
// half of the samples is filtered by weights that come from the other one, so that its noise does not choose.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shaders/post/passes.glsl"
#include "shaders/post/moments.glsl"

// The estimate of a bandwidth from both halves', whose means are `first` and `second`.
void storeFiltered(int place, int bandwidth, float firstShare, vec3 first, vec3 second, vec3 firstFiltered,
                   vec3 secondFiltered) {
    float secondShare = 1.0 - firstShare;
    vec3 estimate = firstFiltered * firstShare + secondFiltered * secondShare;
    vec3 difference = firstFiltered - secondFiltered;
    storeEstimate(place * estimateCount + bandwidth, estimate,
                  relativeError(estimate, first, second, difference * difference * (firstShare * secondShare)));
}

// The noisy colour itself: the first term of its error is 0, and the variance is that of the whole.
void storeNoisy(int place, vec3 noisy, vec3 second) {
    vec3 squares = loadVector(splitTexels, place * splitRows + 3);
    storeEstimate(place * estimateCount + 2, noisy, relativeError(noisy, noisy, second, squares * 0.5));
}

void main() {
    if (!beginPass())
        return;
    int place = placeOf(own);
    float firstShare = noisyNumber(place, 0);
    // The variance of a half's mean is that of all samples' over its share.
    float firstFactor = divide(1.0, firstShare);
    float secondFactor = divide(1.0, 1.0 - firstShare);
    vec3 first = loadVector(splitTexels, place * splitRows);
    vec3 second = loadVector(splitTexels, place * splitRows + 1);
    vec3 variance = loadVector(varianceTexels, place);
    vec3 firstGuide = loadVector(guideTexels, place * guideRows);
    vec3 secondGuide = loadVector(guideTexels, place * guideRows + 1);
    vec3 guideVariance = loadVector(guideTexels, place * guideRows + 2);
    float depth = noisyNumber(place, 1);
    vec3 albedo = noisyVector(place, 3);
    vec3 normal = noisyVector(place, 4);
    float features[featureCount];
    features[0] = 1.0;
    Moments narrowFirst = noMoments();
    Moments wideFirst = noMoments();
    Moments narrowSecond = noMoments();
    Moments wideSecond = noMoments();
    for (int dy = -regressionRadius; dy <= regressionRadius; ++dy)
        for (int dx = -regressionRadius; dx <= regressionRadius; ++dx) {
            ivec2 pixel = own + ivec2(dx, dy);
            bool isInside = pixel.x >= 0 && pixel.x < tileSize.x && pixel.y >= 0 && pixel.y < tileSize.y;
            int other = placeOf(pixel);
            vec3 otherAlbedo = noisyVector(other, 3);
            vec3 otherNormal = noisyVector(other, 4);
            features[1] = featureDifference(otherAlbedo.x, albedo.x);
            features[2] = featureDifference(otherAlbedo.y, albedo.y);
            features[3] = featureDifference(otherAlbedo.z, albedo.z);
            features[4] = featureDifference(otherNormal.x, normal.x);
            features[5] = featureDifference(otherNormal.y, normal.y);
            features[6] = featureDifference(otherNormal.z, normal.z);
            features[7] = depthDifference(noisyNumber(other, 1), depth);
            vec3 otherFirst = loadVector(splitTexels, other * splitRows);
            vec3 otherSecond = loadVector(splitTexels, other * splitRows + 1);
            vec3 otherVariance = loadVector(varianceTexels, other);
            vec3 otherGuideVariance = loadVector(guideTexels, other * guideRows + 2);
            float byFirst = wideWeight(jointDistance(
                colourDistance(loadVector(guideTexels, other * guideRows), firstGuide,
                               otherGuideVariance * firstFactor, guideVariance * firstFactor),
                colourDistance(otherFirst, first, otherVariance * firstFactor, variance * firstFactor)));
            float bySecond = wideWeight(jointDistance(
                colourDistance(loadVector(guideTexels, other * guideRows + 1), secondGuide,
                               otherGuideVariance * secondFactor, guideVariance * secondFactor),
                colourDistance(otherSecond, second, otherVariance * secondFactor, variance * secondFactor)));
            byFirst = isInside ? byFirst : 0.0;
            bySecond = isInside ? bySecond : 0.0;
            add(narrowFirst, narrowWeight(bySecond), features, otherFirst);
            add(wideFirst, bySecond, features, otherFirst);
            add(narrowSecond, narrowWeight(byFirst), features, otherSecond);
            add(wideSecond, byFirst, features, otherSecond);
        }
    storeFiltered(place, 0, firstShare, first, second, solved(narrowFirst), solved(narrowSecond));
    storeFiltered(place, 1, firstShare, first, second, solved(wideFirst), solved(wideSecond));
    storeNoisy(place, first * firstShare + second * (1.0 - firstShare), second);
}
