// Leaf functions as C++: GLSL's words, and the functions that cmake/glsl_to_cpp.cpp makes of shaders/leaves.glsl.
//
// `Real` is float in the twin of the kernels, whose bits are those of a device, and double where the error of float32
// is measured. All is compiled with -ffp-contract=off, so that what stands in the shaders is what is computed.
#pragma once

#include "shaders/layout/layout.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace hyalite::core::leaves {

using glm::max;
using glm::min;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using uint = std::uint32_t;

template <class Real> using Vec2 = glm::vec<2, Real>;
template <class Real> using Vec3 = glm::vec<3, Real>;
template <class Real> using Vec4 = glm::vec<4, Real>;

// ---- Built-in functions

[[nodiscard]] inline float abs(float x) { return std::fabs(x); }
[[nodiscard]] inline double abs(double x) { return std::fabs(x); }
/// glm::abs leaves -0 as it is.
template <class Real> [[nodiscard]] Vec3<Real> abs(const Vec3<Real> &v) {
    return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)};
}
[[nodiscard]] inline float floor(float x) { return std::floor(x); }
[[nodiscard]] inline double floor(double x) { return std::floor(x); }

[[nodiscard]] inline int findLSB(uint x) { return x == 0 ? -1 : std::countr_zero(x); }
[[nodiscard]] inline int findMSB(uint x) { return 31 - std::countl_zero(x); }
[[nodiscard]] inline uint bitfieldReverse(uint x) {
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0F0F0F0Fu) << 4 | (x >> 4 & 0x0F0F0F0Fu);
    x = (x & 0x00FF00FFu) << 8 | (x >> 8 & 0x00FF00FFu);
    return x << 16 | x >> 16;
}
[[nodiscard]] inline float intBitsToFloat(int bits) { return std::bit_cast<float>(bits); }
[[nodiscard]] inline int floatBitsToInt(float x) { return std::bit_cast<int>(x); }
[[nodiscard]] inline int floatBitsToInt(double x) { return floatBitsToInt(static_cast<float>(x)); }
[[nodiscard]] inline float uintBitsToFloat(uint bits) { return std::bit_cast<float>(bits); }
[[nodiscard]] inline glm::vec2 uintBitsToFloat(const uvec2 &bits) {
    return {uintBitsToFloat(bits.x), uintBitsToFloat(bits.y)};
}
[[nodiscard]] inline glm::vec3 uintBitsToFloat(const uvec3 &bits) {
    return {uintBitsToFloat(bits.x), uintBitsToFloat(bits.y), uintBitsToFloat(bits.z)};
}
[[nodiscard]] inline glm::vec4 uintBitsToFloat(const uvec4 &bits) {
    return {uintBitsToFloat(bits.x), uintBitsToFloat(bits.y), uintBitsToFloat(bits.z),
            uintBitsToFloat(bits.w)};
}

// ---- Division and square root. Devices with inexact ones use our own (shaders/math/arithmetic.glsl); here the
// correctly rounded ones of the processor run.

[[nodiscard]] inline float divide(float a, float b) { return a / b; }
[[nodiscard]] inline double divide(double a, double b) { return a / b; }
template <class Real> [[nodiscard]] Vec3<Real> divide(Real a, const Vec3<Real> &b) { return a / b; }
[[nodiscard]] inline float squareRoot(float x) { return std::sqrt(x); }
[[nodiscard]] inline double squareRoot(double x) { return std::sqrt(x); }

// ---- Records and leaf functions

/// What leaf functions read of a scene. host/reference/scene_view.h defines it, for those that need it.
template <class Real> struct SceneView;

#include "leaf_functions.h"

} // namespace hyalite::core::leaves
