// Vector arithmetic with a fixed order of operations. Twin: shaders/math/vector.glsl.
//
// `Real` is float in the twin of the kernels, and double in the oracle that tells how far float32 is from the truth.
// Compiled with -ffp-contract=off, so that what stands here is what is computed.
#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

namespace hyalite::reference {

template <class Real> using Vec2 = glm::vec<2, Real>;
template <class Real> using Vec3 = glm::vec<3, Real>;

template <class Real> [[nodiscard]] Real dotProduct(const Vec3<Real> &a, const Vec3<Real> &b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real> [[nodiscard]] Vec3<Real> crossProduct(const Vec3<Real> &a, const Vec3<Real> &b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real> [[nodiscard]] Real vectorLength(const Vec3<Real> &v) {
    return std::sqrt(dotProduct(v, v));
}

/// `v` is not zero.
template <class Real> [[nodiscard]] Vec3<Real> unitVector(const Vec3<Real> &v) {
    const Real scale = Real(1) / vectorLength(v);
    return v * scale;
}

/// The mirror image of direction `d` at a surface with unit normal `n`, whichever side `n` is on.
template <class Real> [[nodiscard]] Vec3<Real> mirrorDirection(const Vec3<Real> &d, const Vec3<Real> &n) {
    const Real twice = Real(2) * dotProduct(d, n);
    return d - n * twice;
}

/// As abs in GLSL; glm::abs leaves -0 as it is.
template <class Real> [[nodiscard]] Vec3<Real> absolute(const Vec3<Real> &v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// From `a`, share 0, to `b`, share 1.
template <class Real>
[[nodiscard]] Vec3<Real> mixtureOf(const Vec3<Real> &a, const Vec3<Real> &b, Real share) {
    return a + (b - a) * share;
}

/// The lesser of two numbers, and `b` where they are equal or one of them is NaN.
template <class Real> [[nodiscard]] Real lesser(Real a, Real b) { return a < b ? a : b; }

/// The greater of two numbers, and `b` where they are equal or one of them is NaN.
template <class Real> [[nodiscard]] Real greater(Real a, Real b) { return a > b ? a : b; }

template <class Real> [[nodiscard]] Vec3<Real> lesser(const Vec3<Real> &a, const Vec3<Real> &b) {
    return {lesser(a.x, b.x), lesser(a.y, b.y), lesser(a.z, b.z)};
}

template <class Real> [[nodiscard]] Vec3<Real> greater(const Vec3<Real> &a, const Vec3<Real> &b) {
    return {greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z)};
}

template <class Real> [[nodiscard]] Real largestComponent(const Vec3<Real> &v) {
    return greater(greater(v.x, v.y), v.z);
}

template <class Real> [[nodiscard]] Real smallestComponent(const Vec3<Real> &v) {
    return lesser(lesser(v.x, v.y), v.z);
}

/// One unit of rounding: 2^-24 for float, 2^-53 for double.
template <class Real> inline constexpr Real roundingUnit = std::numeric_limits<Real>::epsilon() / 2;

} // namespace hyalite::reference
