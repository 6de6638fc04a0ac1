// What the denoiser makes of numbers; its passes, here and on the host (host/reference/denoise.cpp), say of which.
//
// B. Bitterli, F. Rousselle, B. Moon, J. A. Iglesias-Guitian, D. Adler, K. Mitchell, W. Jarosz, J. Novak, "Nonlinearly
// Weighted First-order Regression for Denoising Monte Carlo Renderings", EGSR 2016: local regression on albedo, normal
// and depth, by weights from the colours of the other half of the samples, in two bandwidths; and what each fit says of
// the pixels around its own, as a mean.

// 1/x within 3e-4 of it, for x in [1e-30, 1e30]: an estimate by the exponent, and two of Newton's steps.
float roughInverse(float x) {
    float estimate = intBitsToFloat(0x7EF311C7 - floatBitsToInt(x));
    estimate = estimate * (2.0 - x * estimate);
    return estimate * (2.0 - x * estimate);
}

// The factor on a pixel that is brighter than its 24 neighbours without a reason: at most a limit beyond the third
// largest of them is left, unless so much is more than two standard deviations of the pixel's own mean. `sum` and
// `largest` are of the neighbours' luminances.
float fireflyFactor(float luminance, float variance, float sum, vec3 largest) {
    float mean = (sum - largest.x - largest.y - largest.z) * (1.0 / 21.0);
    float limit = largest.z + 3.0 * (largest.z - mean) + 1e-4;
    float beyond = luminance - limit;
    return beyond > 0.0 && beyond * beyond < 4.0 * variance ? divide(limit, luminance) : 1.0;
}

// The three largest numbers that are known with one more.
vec3 withLargest(vec3 largest, float x) {
    float first = greater(largest.x, x);
    float rest = lesser(largest.x, x);
    float second = greater(largest.y, rest);
    rest = lesser(largest.y, rest);
    return vec3(first, second, greater(largest.z, rest));
}

// The variance of a mean, whose samples are better spread than independent ones: `variance` and `squares`, that of the
// two halves' means about it, are sums over a neighbourhood.
float varianceRatio(float squares, float variance) {
    return lesser(greater(divide(squares, variance + 1e-12), 0.05), 1.5);
}

// How far two colours are apart beyond their variances, in units of these: around 0 for two estimates of one colour.
float colourDistance(vec3 a, vec3 b, vec3 varianceA, vec3 varianceB) {
    vec3 difference = a - b;
    vec3 both = varianceA + varianceB;
    vec3 beyond = difference * difference - (varianceA + lesser(varianceA, varianceB));
    return (beyond.x * roughInverse(both.x) + beyond.y * roughInverse(both.y) + beyond.z * roughInverse(both.z)) *
           (1.0 / 3.0);
}

// Of two pixels, by the distances of means around them and of themselves, which are noisier.
float jointDistance(float around, float between) {
    return greater(greater(around, between - 3.0), 0.0);
}

// The weight of a neighbour, of which small ones are 0: no product of them is subnormal.
float weightOf(float distance) {
    float weight = expNegative(distance);
    return weight < 1e-6 ? 0.0 : weight;
}

// The difference of a feature, or 0 where it is none.
float featureDifference(float neighbour, float own) {
    float difference = neighbour - own;
    return abs(difference) < 1e-9 ? 0.0 : difference;
}

// That of depths, of any unit, in [-1, 1].
float depthDifference(float neighbour, float own) {
    return featureDifference(neighbour, own) * roughInverse(neighbour + own + 1e-9);
}

// How much a pixel's errors may count, by its luminance and the variance of that: a firefly that is in both halves
// would choose for all pixels around it, as only a small lamp is to do, of whose mean the samples are sure.
float errorLimit(float luminance, float variance) {
    float squared = luminance * luminance;
    return greater(squared * roughInverse(variance + squared * 1e-6 + 1e-20), 8.0);
}

// The squared error of an estimate relative to a colour, up to a sum that is the same for all estimates: by the product
// of what the two halves say, whose noise is independent, and the estimate's variance.
float relativeError(vec3 estimate, vec3 first, vec3 second, vec3 variance, vec3 colour, float limit) {
    vec3 squared = (estimate - first) * (estimate - second) + 2.0 * variance;
    vec3 scale = colour * colour + 0.01;
    return withoutTiny(lesser(squared.x * roughInverse(scale.x) + squared.y * roughInverse(scale.y) +
                                  squared.z * roughInverse(scale.z),
                              limit));
}

// The factor on the share of the noisy colour in a pixel, by how many of the pixels further around have chosen it, some
// of them counted twice: 40 are the middle between none and all of it. A few alone are those that have all missed rare
// light, and look as if they had no noise.
float noisyFactor(float count) { return lesser(greater((count - 20.0) * 0.025, 0.0), 1.0); }

// Whether a pixel has no noise: its mean has a standard deviation below a thousandth of it, and is not below that of
// the pixels around it, as where all samples have missed a light; unless these are so bright that they are the edge of
// a lamp.
bool isCertain(vec3 colour, vec3 variance, vec3 around) {
    vec3 allowed = colour * colour * 1e-6;
    vec3 least = around * 0.999;
    bool isDarker = colour.x < least.x || colour.y < least.y || colour.z < least.z;
    bool isBesideLamp = luminance(colour) * 64.0 < luminance(around);
    return variance.x < allowed.x && variance.y < allowed.y && variance.z < allowed.z && (!isDarker || isBesideLamp);
}
