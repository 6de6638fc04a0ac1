// Sine, cosine and exponential from + - * alone, the same bits everywhere. Twin: host/reference/functions.h.

struct SineCosine {
    float sine;
    float cosine;
};

// Of an angle in turns, in [0, 1]. The Taylor polynomials of both on an eighth of a turn to either side of the nearest
// quarter, where they are within 3e-8.
SineCosine sineCosine(float turns) {
    int quarter = int(turns * 4.0 + 0.5);
    precise float x = (turns - float(quarter) * 0.25) * 6.2831853071795865;
    precise float xx = x * x;
    precise float s = x + x * xx * (-1.0 / 6.0 + xx * (1.0 / 120.0 + xx * (-1.0 / 5040.0 + xx * (1.0 / 362880.0))));
    precise float c = 1.0 + xx * (-0.5 + xx * (1.0 / 24.0 + xx * (-1.0 / 720.0 + xx * (1.0 / 40320.0))));
    bool isSwapped = (quarter & 1) != 0;
    float sine = isSwapped ? c : s;
    float cosine = isSwapped ? s : c;
    return SineCosine((quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine);
}

// e^-x for x >= 0: a power of 2 as an exponent, and the Taylor polynomial around the middle of what remains.
// Within 2e-7 (1 + x) of the result, exactly 1 at 0, and 0 from 86 on.
float decay(float x) {
    precise float t = lesser(x, 86.0) * 1.4426950408889634;
    int k = int(t);
    precise float y = (float(k) + 0.5 - t) * 0.69314718055994531;
    precise float power =
        1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y * (1.0 / 24.0 + y * (1.0 / 120.0 + y * (1.0 / 720.0))))));
    precise float scaled = power * (intBitsToFloat((127 - k) << 23) * 0.70710678118654752);
    return x < 86.0 ? (x > 0.0 ? scaled : 1.0) : 0.0;
}

vec3 decay(vec3 x) { return vec3(decay(x.x), decay(x.y), decay(x.z)); }
