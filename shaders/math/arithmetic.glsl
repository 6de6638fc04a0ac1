// Division and square root, correctly rounded (to nearest, ties to even) on every device.
//
// Vulkan allows an error of 2.5 units in a / b, and more in sqrt. The device's own operators run only where the host
// knows that they are exact (constant hasExactDivision); elsewhere these functions do, which need only + - * and
// integers. The last bit never depends on a float operation: floats only estimate, and what follows is integer
// arithmetic modulo 2^32 on a remainder that is known to be small. So the proofs ask little of a device: u = 2^-23
// bounds the relative error of one float operation, which holds in any rounding mode, fused or not.
//
// Exactly IEEE 754 wherever inputs and result are normal, zero, infinite or NaN. Subnormal inputs count as zeros,
// and quotients below 2^-126 become zeros, as devices may do for + - *. No picture depends on subnormal numbers.

// All integers are signed, because CPUs convert and compare signed ones faster. Magnitudes have 31 bits.

const int signBit = int(0x80000000u);
const int magnitudeMask = 0x7FFFFFFF;
const int infinityBits = 0x7F800000;
const int notANumberBits = 0x7FC00000;
const int significandMask = 0x7FFFFF;
const int significandOne = 0x800000; // 1.0 as a significand: an integer with 24 bits
const int farExponent = 1000;        // stands for an infinity, negated for a zero

// Rounds to the nearest integer or to the one below it. Estimates are within 2^-13 of the true value.
const float justBelowHalf = 0.5 - 1.0 / 8192.0;

// The significand of `bits` as a float in [1, 2).
float unitSignificand(int bits) { return intBitsToFloat((bits & significandMask) | 0x3F800000); }

// 1/d within 11 u, for d in [1, 2). The seed is the minimax quadratic, with relative error T3(2d - 3) / 99, so
// |e| <= 1/99, and one step of third order leaves e^3 = 8.7 u; rounding adds 2.1 u.
float estimateInverse(float d) {
    float seed = (d * (32.0 / 99.0) - 16.0 / 11.0) * d + 70.0 / 33.0;
    float e = 1.0 - d * seed;
    return seed + seed * (e + e * e);
}

// 1/sqrt(d) within 3 u, for d in [1, 2). The seed is the minimax quadratic, with relative error 1/313, so
// |e| <= 1/156, and one step of third order leaves 5/16 e^3 = 0.7 u; rounding adds 2.1 u.
float estimateInverseRoot(float d) {
    float seed = (d * 0.14768758 - 0.73051435) * d + 1.5796391;
    float e = 1.0 - d * (seed * seed);
    return seed + seed * (e * (e * 0.375 + 0.5));
}

int exponentOrFar(int magnitude) {
    int exponent = magnitude >> 23;
    return exponent == 0 ? -farExponent : (exponent == 255 ? farExponent : exponent);
}

// Let A and B be the significands and k = 23 or 24 such that t = 2^k A / B lies in [2^23, 2^24): the significand of
// the result is t to the nearest integer.
//   1. low = estimate - 26. The estimate is off by 12 u t <= 24, and by 1 for the fraction cut off, so
//      1 < t - low < 52, and the remainder 2^k A - low B lies in (0, 52 * 2^24): 32 bits hold it.
//   2. remainder / B is t - low, and its estimate is off by 13 u * 52 and the rounding of a sum: less than 2^-13.
//      So `step` is t - low to the nearest integer, or 1 less.
//   3. An exact comparison tells which. There are no ties: t = n + 1/2 would make 2^(k+1) A = (2n + 1) B, where the
//      odd part of the right side has at least 25 bits, and that of the left side at most 24. Nor does t round to
//      2^24: where A < B, t <= 2^24 (B - 1) / B < 2^24 - 1, and else t <= 2^23 (2^24 - 1) / 2^23.
float divideBySignificands(float a, float b) {
    int aBits = floatBitsToInt(a);
    int bBits = floatBitsToInt(b);
    int aSignificand = (aBits & significandMask) | significandOne;
    int bSignificand = (bBits & significandMask) | significandOne;
    bool isBelowOne = aSignificand < bSignificand;
    int numerator = isBelowOne ? aSignificand << 1 : aSignificand;

    float inverse = estimateInverse(unitSignificand(bBits));
    float estimate = float(numerator) * inverse;
    int low = int(estimate) - 26;
    int remainder = (numerator << 23) - low * bSignificand;
    float distance = float(remainder) * (inverse * (1.0 / 8388608.0)) + justBelowHalf;
    int step = int(distance);
    int rest = remainder - step * bSignificand;
    int significand = low + step + (2 * rest > bSignificand ? 1 : 0);

    int aMagnitude = aBits & magnitudeMask;
    int bMagnitude = bBits & magnitudeMask;
    int aExponent = exponentOrFar(aMagnitude);
    int bExponent = exponentOrFar(bMagnitude);
    int exponent = aExponent - bExponent + (isBelowOne ? 126 : 127);
    int magnitude = (exponent << 23) + (significand - significandOne);
    magnitude = exponent <= 0 ? 0 : (exponent >= 255 ? infinityBits : magnitude);
    bool isBothFar = aExponent == bExponent && abs(aExponent) == farExponent; // 0 / 0, infinity / infinity
    bool isNan = max(aMagnitude, bMagnitude) > infinityBits || isBothFar;
    return intBitsToFloat(isNan ? notANumberBits : magnitude | ((aBits ^ bBits) & signBit));
}

// Let X be the significand times 2^23 or 2^24, whichever makes the exponent even: t = sqrt(X) lies in [2^23, 2^24),
// and the significand of the result is t to the nearest integer.
//   1. low = estimate - 12. The estimate is off by 5.3 u t <= 10.6, and by 1 for the fraction cut off, so
//      1 < t - low < 24, and the remainder X - low^2 = (t - low)(t + low) lies in (0, 24 * 2^25): 32 bits hold it.
//   2. remainder / 2t is less than t - low by (t - low)^2 / 2t < 2^-14.8, and its estimate is off by 7 u * 24 and
//      the rounding of a sum: together less than 2^-13. So `step` is t - low to the nearest integer, or 1 less.
//   3. An exact comparison tells which: t > n + 1/2 where X - n^2 > n + 1/4. There are no ties, and t < 2^24 - 1/2.
float rootBySignificand(float x) {
    int bits = floatBitsToInt(x);
    int exponent = bits >> 23;
    bool isDoubled = (exponent & 1) == 0; // 127, the bias, is odd
    int square = ((bits & significandMask) | significandOne) << (isDoubled ? 24 : 23); // modulo 2^32

    float unit = unitSignificand(bits);
    float inverse = estimateInverseRoot(unit);
    float estimate = unit * (inverse * (isDoubled ? 11863283.0 : 8388608.0)); // 2^23, times sqrt(2)
    int low = int(estimate) - 12;
    int remainder = square - low * low;
    float halfInverse = inverse * (isDoubled ? 4.2146848e-8 : 5.9604645e-8); // 1/2t
    float distance = float(remainder) * halfInverse + justBelowHalf;
    int step = int(distance);
    int significand = low + step;
    int rest = remainder - step * (low + significand);
    significand += rest > significand ? 1 : 0;

    int result = (((exponent + 127) >> 1) << 23) + (significand - significandOne);
    result = bits == infinityBits ? infinityBits : result;
    result = bits < 0 || bits > infinityBits ? notANumberBits : result;
    return intBitsToFloat((bits & magnitudeMask) < significandOne ? bits & signBit : result);
}

float divide(float a, float b) {
    if (!hasExactDivision)
        return divideBySignificands(a, b);
    return a / b;
}

vec3 divide(float a, vec3 b) { return vec3(divide(a, b.x), divide(a, b.y), divide(a, b.z)); }

float squareRoot(float x) { return hasExactDivision ? sqrt(x) : rootBySignificand(x); }
