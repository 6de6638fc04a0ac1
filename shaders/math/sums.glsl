// The sums of a film, which do not drift: each has a second number, the rest that its rounding has left out.

struct CompensatedSum {
    vec3 value; // the nearest float to the sum
    vec3 rest;  // the sum less `value`
};

// The rest beside a sum. It is 0 beside one that has left the range of floats, and where it is tiny: then no subnormal number,
// which drivers may flush, decides any of its bits.
float restOf(float value, float rest) { return abs(value) <= 3.4028234e38 && abs(rest) >= 1e-30 ? rest : 0.0; }

// Kahan, "Further Remarks on Reducing Truncation Errors", CACM 8(1), 1965, with Knuth's exact difference in place of his, so
// that an added number may be larger than the sum. The relative error of n additions of like sign is that of one. Adding 0
// changes no bit.
CompensatedSum plus(CompensatedSum sum, vec3 added) {
    vec3 term = added + sum.rest;
    vec3 value = sum.value + term;
    vec3 fromTerm = value - sum.value;
    vec3 fromSum = value - fromTerm;
    vec3 lostOfSum = sum.value - fromSum;
    vec3 lostOfTerm = term - fromTerm;
    vec3 rest = lostOfSum + lostOfTerm;
    return CompensatedSum(value, vec3(restOf(value.x, rest.x), restOf(value.y, rest.y), restOf(value.z, rest.z)));
}

// A pixel of the film with the radiance of one more sample. Its count is the caller's.
FilmPixel withSample(FilmPixel pixel, vec3 sampleRadiance) {
    vec3 radiance = withoutSubnormals(sampleRadiance);
    CompensatedSum sum = plus(CompensatedSum(pixel.sum, pixel.sumRest), radiance);
    CompensatedSum squares =
        plus(CompensatedSum(pixel.sumOfSquares, pixel.squaresRest), withoutSubnormals(radiance * radiance));
    pixel.sum = sum.value;
    pixel.sumRest = sum.rest;
    pixel.sumOfSquares = squares.value;
    pixel.squaresRest = squares.rest;
    return pixel;
}
