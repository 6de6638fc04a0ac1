// Vector arithmetic with a fixed order of operations. Twin: host/reference/vector.h.
//
// The built-in dot, cross, normalize and reflect may be evaluated in any order, so they are ours. `precise` forbids
// contraction to fused operations, but only inside the function where it stands: every sum that reaches a picture is
// `precise` in its own function, and that keeps products from being fused into it. Only parameters and locals are ever
// `precise`: glslang 12 follows the word through assignments of global structs and may never come back.

vec3 add(vec3 a, vec3 b) {
    precise vec3 sum = a + b;
    return sum;
}

vec3 subtract(vec3 a, vec3 b) {
    precise vec3 difference = a - b;
    return difference;
}

vec3 addProduct(vec3 a, vec3 b, vec3 c) {
    precise vec3 product = b * c;
    precise vec3 sum = a + product;
    return sum;
}

float dotProduct(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

vec3 crossProduct(vec3 a, vec3 b) {
    precise float x = a.y * b.z - a.z * b.y;
    precise float y = a.z * b.x - a.x * b.z;
    precise float z = a.x * b.y - a.y * b.x;
    return vec3(x, y, z);
}

float vectorLength(vec3 v) {
    precise float squared = dotProduct(v, v);
    return squareRoot(squared);
}

// `v` is not zero.
vec3 unitVector(vec3 v) {
    float scale = divide(1.0, vectorLength(v));
    precise vec3 unit = v * scale;
    return unit;
}

// The mirror image of direction `d` at a surface with unit normal `n`, whichever side `n` is on.
vec3 mirrorDirection(vec3 d, vec3 n) {
    precise float twice = 2.0 * dotProduct(d, n);
    precise vec3 mirrored = d - n * twice;
    return mirrored;
}

// From `a`, share 0, to `b`, share 1.
vec3 mixtureOf(vec3 a, vec3 b, float share) {
    precise vec3 mixed = a + (b - a) * share;
    return mixed;
}

// The lesser and the greater of two numbers, and `b` where they are equal or one of them is NaN. The built-in min and max
// leave that open; and on lavapipe they are three instructions, these are one.
float lesser(float a, float b) { return a < b ? a : b; }

float greater(float a, float b) { return a > b ? a : b; }

vec3 lesser(vec3 a, vec3 b) { return vec3(lesser(a.x, b.x), lesser(a.y, b.y), lesser(a.z, b.z)); }

vec3 greater(vec3 a, vec3 b) { return vec3(greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z)); }

float largestComponent(vec3 v) { return greater(greater(v.x, v.y), v.z); }

float smallestComponent(vec3 v) { return lesser(lesser(v.x, v.y), v.z); }
