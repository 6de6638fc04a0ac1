// Conversion, sine, cosine, arc tangent and exponential, made of + - * only, with the same bits everywhere.

// The number as a float, rounded once. Of drivers, not all do so from 2^31 on: SwiftShader converts all but the highest
// bit, and adds that.
float floatOf(uint x) { return float(x >> 16u) * 65536.0 + float(x & 0xFFFFu); }

struct SineCosine {
    float sine;
    float cosine;
};

// Sine and cosine of an angle in turns, in [-8, 8], by Taylor polynomials within an eighth of a turn around the nearest
// quarter, where their error is below 3e-8.
SineCosine sineCosine(float turns) {
    int quarter = int(floor(turns * 4.0 + 0.5));
    float x = (turns - float(quarter) * 0.25) * 6.2831853071795865;
    float xx = x * x;
    float s = x + x * xx * (-1.0 / 6.0 + xx * (1.0 / 120.0 + xx * (-1.0 / 5040.0 + xx * (1.0 / 362880.0))));
    float c = 1.0 + xx * (-0.5 + xx * (1.0 / 24.0 + xx * (-1.0 / 720.0 + xx * (1.0 / 40320.0))));
    bool isSwapped = (quarter & 1) != 0;
    float sine = isSwapped ? c : s;
    float cosine = isSwapped ? s : c;
    return SineCosine((quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine);
}

// The angle from the x axis to the vector (x, y), which is not 0, in turns, in [0, 1], within 1e-7. Taylor polynomial
// of the arc tangent up to tan(1/16 turn), where its error is below 2e-8; beyond, of the angle to the diagonal.
float atan2Turns(float y, float x) {
    float low = lesser(abs(x), abs(y));
    float high = greater(abs(x), abs(y));
    float limit = high * 0.41421356237309505;
    bool isFar = low > limit;
    float difference = low - high;
    float sum = low + high;
    float t = divide(isFar ? difference : low, isFar ? sum : high);
    float tt = t * t;
    float series =
        -1.0 / 3.0 +
        tt * (1.0 / 5.0 +
              tt * (-1.0 / 7.0 + tt * (1.0 / 9.0 + tt * (-1.0 / 11.0 + tt * (1.0 / 13.0 + tt * (-1.0 / 15.0))))));
    float angle = (t + t * tt * series) * 0.15915494309189535;
    float eighth = angle + 0.125;
    float turns = isFar ? eighth : angle;
    float quarter = 0.25 - turns;
    turns = abs(y) > abs(x) ? quarter : turns;
    float mirrored = 0.5 - turns;
    turns = x < 0.0 ? mirrored : turns;
    float whole = 1.0 - turns;
    return y < 0.0 ? whole : turns;
}

// e^-x for x >= 0: a power of 2 for the exponent, and the Taylor polynomial around the middle of the remaining
// interval. Within 2e-7 (1 + x) of the result, exactly 1 at 0, and 0 from 86 on.
float expNegative(float x) {
    float t = lesser(x, 86.0) * 1.4426950408889634;
    int k = int(t);
    float y = (float(k) + 0.5 - t) * 0.69314718055994531;
    float power =
        1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y * (1.0 / 24.0 + y * (1.0 / 120.0 + y * (1.0 / 720.0))))));
    float scaled = power * (intBitsToFloat((127 - k) << 23) * 0.70710678118654752);
    return x < 86.0 ? (x > 0.0 ? scaled : 1.0) : 0.0;
}

// e^x for x in [-86, 86].
float exponential(float x) {
    float power = expNegative(abs(x));
    return x < 0.0 ? power : divide(1.0, power);
}

// -ln x for x in (0, 1] that is not subnormal, within 2e-7 (1 - ln x): the exponent, and the series of the inverse
// hyperbolic tangent for a significand within a factor of sqrt(2) of 1.
float negativeLog(float x) {
    int bits = floatBitsToInt(x);
    int exponent = (bits >> 23) - 127;
    float significand = intBitsToFloat((bits & 0x7FFFFF) | 0x3F800000);
    bool isUpper = significand > 1.4142135623730951;
    float m = isUpper ? 0.5 * significand : significand;
    float k = float(isUpper ? exponent + 1 : exponent);
    float below = m - 1.0;
    float above = m + 1.0;
    float t = divide(below, above);
    float tt = t * t;
    float series = t * (2.0 + tt * (2.0 / 3.0 + tt * (2.0 / 5.0 + tt * (2.0 / 7.0 + tt * (2.0 / 9.0)))));
    return -(k * 0.69314718055994531 + series);
}

vec3 expNegative(vec3 x) { return vec3(expNegative(x.x), expNegative(x.y), expNegative(x.z)); }
