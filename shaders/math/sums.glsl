// The sums of a film, which do not drift: each has a second number, the rest that its rounding has left out.

struct CompensatedSum {
    float value; // the nearest float to the sum
    float rest;  // the sum less `value`
};

// Kahan, "Further Remarks on Reducing Truncation Errors", CACM 8(1), 1965, with Knuth's exact difference instead of
// his, so that an added number may be larger than the sum. The relative error of n additions of like sign is that of
// one. Adding 0 changes no bit.
CompensatedSum plus(CompensatedSum sum, float added) {
    float term = added + sum.rest;
    float value = sum.value + term;
    float fromTerm = value - sum.value;
    float fromSum = value - fromTerm;
    float lostOfSum = sum.value - fromSum;
    float lostOfTerm = term - fromTerm;
    float rest = lostOfSum + lostOfTerm;
    // There is no rest beside a sum that has left the range of floats, nor where it is tiny: then no subnormal number,
    // which drivers may flush, decides any of its bits.
    bool isKept = abs(value) <= 3.4028234e38 && abs(rest) >= 1e-30;
    return CompensatedSum(value, isKept ? rest : 0.0);
}

// A pixel of the film with one more addend to each sum. Its count is the caller's.
FilmPixel withAddends(FilmPixel pixel, vec3 radiance, vec3 squared, float transparency) {
    for (int channel = 0; channel < 3; ++channel) {
        CompensatedSum sum = plus(CompensatedSum(pixel.sum[channel], pixel.sumRest[channel]), radiance[channel]);
        CompensatedSum squares =
            plus(CompensatedSum(pixel.sumOfSquares[channel], pixel.squaresRest[channel]), squared[channel]);
        pixel.sum[channel] = sum.value;
        pixel.sumRest[channel] = sum.rest;
        pixel.sumOfSquares[channel] = squares.value;
        pixel.squaresRest[channel] = squares.rest;
    }
    CompensatedSum clear = plus(CompensatedSum(pixel.transparency, pixel.transparencyRest), transparency);
    pixel.transparency = clear.value;
    pixel.transparencyRest = clear.rest;
    return pixel;
}

// With one more sample.
FilmPixel withSample(FilmPixel pixel, vec3 sampleRadiance, float sampleTransparency) {
    vec3 radiance = withoutSubnormals(sampleRadiance);
    return withAddends(pixel, radiance, withoutSubnormals(radiance * radiance), sampleTransparency);
}
