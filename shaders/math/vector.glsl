// Vector arithmetic in a fixed order of operations, which GLSL leaves open for dot, cross, normalize and reflect.

float dotProduct(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

vec3 crossProduct(vec3 a, vec3 b) {
    float x = a.y * b.z - a.z * b.y;
    float y = a.z * b.x - a.x * b.z;
    float z = a.x * b.y - a.y * b.x;
    return vec3(x, y, z);
}

float vectorLength(vec3 v) {
    float squared = dotProduct(v, v);
    return squareRoot(squared);
}

// `v` is not zero.
vec3 unitVector(vec3 v) {
    float scale = divide(1.0, vectorLength(v));
    return v * scale;
}

// The mirror image of direction `d` at a surface with unit normal `n`, whichever side `n` is on.
vec3 mirrorDirection(vec3 d, vec3 n) {
    float twice = 2.0 * dotProduct(d, n);
    return d - n * twice;
}

// Linear interpolation: `a` at share 0, `b` at share 1.
vec3 mixtureOf(vec3 a, vec3 b, float share) {
    return a + (b - a) * share;
}

// Minimum and maximum; `b` if the numbers are equal or one of them is NaN, which the built-in min and max leave open.
// On lavapipe those take three instructions, and these one.
float lesser(float a, float b) { return a < b ? a : b; }

float greater(float a, float b) { return a > b ? a : b; }

vec3 lesser(vec3 a, vec3 b) { return vec3(lesser(a.x, b.x), lesser(a.y, b.y), lesser(a.z, b.z)); }

vec3 greater(vec3 a, vec3 b) { return vec3(greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z)); }

// The number, or 0 if it is subnormal: drivers may flush those, or keep them.
float withoutSubnormals(float x) { return abs(x) < 1.1754943508222875e-38 ? 0.0 : x; }

vec3 withoutSubnormals(vec3 v) {
    return vec3(withoutSubnormals(v.x), withoutSubnormals(v.y), withoutSubnormals(v.z));
}

// The share of light that a path carries, without components that no picture shows: of those, a few more factors make
// subnormal numbers, and others large ones again.
float withoutTiny(float x) { return abs(x) < 1e-30 ? 0.0 : x; }

vec3 withoutTiny(vec3 v) { return vec3(withoutTiny(v.x), withoutTiny(v.y), withoutTiny(v.z)); }

float largestComponent(vec3 v) { return greater(greater(v.x, v.y), v.z); }

// Of linear colours with the primaries of Rec. 709.
float luminance(vec3 colour) { return dotProduct(colour, vec3(0.2126, 0.7152, 0.0722)); }

// The mean of colour channels that are not negative, without what no picture shows.
float meanComponent(vec3 v) {
    float sum = v.x + v.y + v.z;
    return withoutTiny(sum * 0.33333334);
}

float smallestComponent(vec3 v) { return lesser(lesser(v.x, v.y), v.z); }
