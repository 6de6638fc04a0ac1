// Random numbers and Sobol points from integer hashes, without state and in any order.

// Three hashes of three keys. Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020: pcg3d.
uvec3 hashKeys(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// Owen's nested uniform scramble of the bits of `x`, by hashing. Burley, "Practical Hash-based Owen Scrambling",
// JCGT 9(4), 2020, section 3 (Laine and Karras 2011 with better constants).
uint owenScramble(uint x, uint key) {
    x = bitfieldReverse(x);
    x += key;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return bitfieldReverse(x);
}

// The second Sobol coordinate of the point whose first coordinate (the bit-reversed index) is `x`. Its generator
// matrix is Pascal's triangle modulo 2, a Kronecker power of ((1,1),(0,1)): one step for each factor.
uint secondSobolCoordinate(uint x) {
    x ^= (x << 1u) & 0xAAAAAAAAu;
    x ^= (x << 2u) & 0xCCCCCCCCu;
    x ^= (x << 4u) & 0xF0F0F0F0u;
    x ^= (x << 8u) & 0xFF00FF00u;
    x ^= (x << 16u) & 0xFFFF0000u;
    return x;
}

// In [0, 1): the upper 24 bits, which a float holds exactly.
float unitFloat(uint x) { return float(x >> 8u) * (1.0 / 16777216.0); }

// Hash keys of a pair of dimensions (dimensions.glsl) of a pixel: each pair has a pattern of its own.
uvec3 pairKeys(uvec2 pixel, uint seed, uint pair) {
    uvec3 keys = hashKeys(uvec3(pixel, seed));
    return pair == pixelPair ? keys : hashKeys(keys ^ pair);
}

// Two coordinates of a sample, as fractions of 2^32: shuffled, scrambled Sobol points, so that any first 2^k samples of
// a pixel are stratified, and no two pixels and no two pairs share a pattern.
uvec2 sampleBits(uvec3 keys, uint sampleIndex) {
    uint first = bitfieldReverse(owenScramble(sampleIndex, keys.x));
    uint second = secondSobolCoordinate(first);
    return uvec2(owenScramble(first, keys.y), owenScramble(second, keys.z));
}

vec2 unitFloats(uvec2 bits) { return vec2(unitFloat(bits.x), unitFloat(bits.y)); }

// Position of sample `sampleIndex` in its pixel, in [0,1)^2.
vec2 samplePixel(uvec2 pixel, uint sampleIndex, uint seed) {
    if (samplerKind == samplerCentre)
        return vec2(0.5);
    return unitFloats(sampleBits(pairKeys(pixel, seed, pixelPair), sampleIndex));
}

// Decides whether a ray passes through an alpha-tested surface: a number in [0, 1) for each primitive at each vertex of
// a path, whatever the order in which rays meet primitives. `vertex` counts rays: two for each segment, the second one
// to a light.
float alphaTestNumber(uvec2 pixel, uint seed, uint sampleIndex, uint vertex, uint primitive) {
    uvec3 keys = hashKeys(uvec3(pixel, seed)) ^ uvec3(primitive, vertex, alphaTestPair);
    return unitFloat(sampleBits(hashKeys(keys), sampleIndex).x);
}
