// Which glass is around a point, where solids of glass lie in each other or overlap. Twin: shaders/bsdf/media.glsl.
//
// `inside` counts in 4 bits for each of the first dielectrics how many of its surfaces a path has entered and not left.
// What is there is the one of highest priority: Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", JGT
// 7(2), 2002. As materials are sorted by priority, it is the lowest one that is counted.
#pragma once

#include "shaders/layout/layout.h"

#include <bit>
#include <cstdint>

namespace hyalite::reference {

inline constexpr std::uint32_t mediumBits = 4;

/// The material around, or noMaterial.
[[nodiscard]] inline std::uint32_t mediumAround(std::uint32_t inside) {
    return inside == 0 ? layout::noMaterial
                       : static_cast<std::uint32_t>(std::countr_zero(inside)) / mediumBits;
}

[[nodiscard]] inline std::uint32_t mediumCount(std::uint32_t inside, std::uint32_t material) {
    return inside >> (material * mediumBits) & 15u;
}

/// Beyond 15 nothing is counted.
[[nodiscard]] inline std::uint32_t enterMedium(std::uint32_t inside, std::uint32_t material) {
    return mediumCount(inside, material) < 15u ? inside + (1u << (material * mediumBits)) : inside;
}

/// What was not entered is not left.
[[nodiscard]] inline std::uint32_t leaveMedium(std::uint32_t inside, std::uint32_t material) {
    return mediumCount(inside, material) > 0u ? inside - (1u << (material * mediumBits)) : inside;
}

} // namespace hyalite::reference
