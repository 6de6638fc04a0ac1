// A level's pixel, and how alike two of them are.
struct LevelPixel {
    float firstShare;
    vec3 first;
    vec3 second;
    vec3 variance;
    vec3 firstGuide;
    vec3 secondGuide;
    vec3 guideVariance;
    vec3 albedo;
    vec3 normal;
    float depth;
};

LevelPixel loadLevel(int place) {
    LevelPixel pixel;
    pixel.firstShare = loadNumber(levelTexels, place + levelFirst);
    pixel.first = loadVector(levelTexels, place + levelFirst);
    pixel.second = loadVector(levelTexels, place + levelSecond);
    pixel.variance = loadVector(levelTexels, place + levelVariance);
    pixel.firstGuide = loadVector(levelTexels, place + levelGuides);
    pixel.secondGuide = loadVector(levelTexels, place + levelGuides + 1);
    pixel.guideVariance = loadVector(levelTexels, place + levelGuides + 2);
    pixel.albedo = loadVector(levelTexels, place + levelAlbedo);
    pixel.depth = loadNumber(levelTexels, place + levelAlbedo);
    [[unroll]] for (int i = 0; i < 3; ++i)
        pixel.normal[i] = loadNumber(levelTexels, place + levelGuides + i);
    return pixel;
}

void storeLevel(int place, const LevelPixel pixel) {
    storeWithNumber(levelTexels, place + levelFirst, pixel.first, pixel.firstShare);
    storeVector(levelTexels, place + levelSecond, pixel.second);
    storeVector(levelTexels, place + levelVariance, pixel.variance);
    storeWithNumber(levelTexels, place + levelGuides, pixel.firstGuide, pixel.normal.x);
    storeWithNumber(levelTexels, place + levelGuides + 1, pixel.secondGuide, pixel.normal.y);
    storeWithNumber(levelTexels, place + levelGuides + 2, pixel.guideVariance, pixel.normal.z);
    storeWithNumber(levelTexels, place + levelAlbedo, pixel.albedo, pixel.depth);
}

// The variance of a half's mean is that of all samples' over its share: the factors of both halves.
vec2 factorsOf(const LevelPixel pixel) {
    return vec2(divide(1.0, pixel.firstShare), divide(1.0, 1.0 - pixel.firstShare));
}

// By the first half of the samples, and by the second.
vec2 distancesOf(const LevelPixel a, const LevelPixel b, vec2 factors) {
    return vec2(jointDistance(colourDistance(a.firstGuide, b.firstGuide, a.guideVariance * factors.x,
                                             b.guideVariance * factors.x),
                              colourDistance(a.first, b.first, a.variance * factors.x, b.variance * factors.x)),
                jointDistance(colourDistance(a.secondGuide, b.secondGuide, a.guideVariance * factors.y,
                                             b.guideVariance * factors.y),
                              colourDistance(a.second, b.second, a.variance * factors.y, b.variance * factors.y)));
}

// Of a pixel by an anchor: a constant, and differences.
void featuresOf(const LevelPixel pixel, const LevelPixel anchor, out float features[featureCount]) {
    features[0] = 1.0;
    features[1] = featureDifference(pixel.albedo.x, anchor.albedo.x);
    features[2] = featureDifference(pixel.albedo.y, anchor.albedo.y);
    features[3] = featureDifference(pixel.albedo.z, anchor.albedo.z);
    features[4] = featureDifference(pixel.normal.x, anchor.normal.x);
    features[5] = featureDifference(pixel.normal.y, anchor.normal.y);
    features[6] = featureDifference(pixel.normal.z, anchor.normal.z);
    features[7] = depthDifference(pixel.depth, anchor.depth);
}
