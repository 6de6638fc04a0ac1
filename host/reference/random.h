// Sample points from integer hashes: no state, no order. Twin: shaders/math/random.glsl.
#pragma once

#include "host/reference/vector.h"
#include "shaders/layout/layout.h"

#include <cstdint>

namespace hyalite::reference {

/// Three hashes of three keys. Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020: pcg3d.
[[nodiscard]] inline glm::uvec3 hashKeys(glm::uvec3 v) {
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

[[nodiscard]] inline std::uint32_t reverseBits(std::uint32_t x) {
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0F0F0F0Fu) | (x & 0x0F0F0F0Fu) << 4;
    x = (x >> 8 & 0x00FF00FFu) | (x & 0x00FF00FFu) << 8;
    return x >> 16 | x << 16;
}

/// Owen's nested uniform scramble of the bits of `x`, by hashing. Burley, "Practical Hash-based Owen Scrambling",
/// JCGT 9(4), 2020, section 3 (Laine and Karras 2011 with better constants).
[[nodiscard]] inline std::uint32_t owenScramble(std::uint32_t x, std::uint32_t key) {
    x = reverseBits(x);
    x += key;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reverseBits(x);
}

/// The second Sobol coordinate of the point whose first coordinate (the bit-reversed index) is `x`. Its generator
/// matrix is Pascal's triangle modulo 2, a Kronecker power of ((1,1),(0,1)): one step for each factor.
[[nodiscard]] inline std::uint32_t secondSobolCoordinate(std::uint32_t x) {
    x ^= (x << 1) & 0xAAAAAAAAu;
    x ^= (x << 2) & 0xCCCCCCCCu;
    x ^= (x << 4) & 0xF0F0F0F0u;
    x ^= (x << 8) & 0xFF00FF00u;
    x ^= (x << 16) & 0xFFFF0000u;
    return x;
}

/// In [0, 1): the upper 24 bits, which a float holds exactly.
template <class Real> [[nodiscard]] Real unitReal(std::uint32_t x) {
    return static_cast<Real>(x >> 8) * Real(1.0 / 16777216.0);
}

/// Keys of the pair of dimensions `pair` of a pixel: each pair is a pattern of its own.
[[nodiscard]] inline glm::uvec3 pairKeys(const glm::uvec2 &pixel, std::uint32_t seed, std::uint32_t pair) {
    const glm::uvec3 keys = hashKeys(glm::uvec3(pixel, seed));
    return pair == 0 ? keys : hashKeys(keys ^ pair);
}

/// Two coordinates of a sample, as fractions of 2^32: shuffled, scrambled Sobol points, so that any first 2^k samples of
/// a pixel are stratified, and no two pixels and no two pairs share a pattern.
[[nodiscard]] inline glm::uvec2 sampleBits(const glm::uvec3 &keys, std::uint32_t sampleIndex) {
    const std::uint32_t first = reverseBits(owenScramble(sampleIndex, keys.x));
    const std::uint32_t second = secondSobolCoordinate(first);
    return {owenScramble(first, keys.y), owenScramble(second, keys.z)};
}

template <class Real> [[nodiscard]] Vec2<Real> unitReals(const glm::uvec2 &bits) {
    return {unitReal<Real>(bits.x), unitReal<Real>(bits.y)};
}

/// Where sample `sampleIndex` of a pixel lies inside of it, in [0,1)^2. It is pair 0.
template <class Real>
[[nodiscard]] Vec2<Real> samplePixel(std::uint32_t samplerKind, const glm::uvec2 &pixel,
                                     std::uint32_t sampleIndex, std::uint32_t seed) {
    if (samplerKind == layout::samplerCentre)
        return Vec2<Real>(Real(0.5));
    return unitReals<Real>(sampleBits(pairKeys(pixel, seed, 0), sampleIndex));
}

} // namespace hyalite::reference
