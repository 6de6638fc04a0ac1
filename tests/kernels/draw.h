// Random inputs of the kernel tests, with the hard ones among them: the same in every run.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <random>

namespace hyalite::core::testing {

class Draw {
  public:
    static constexpr std::uint32_t seed = 20240607;

    /// Any word; often one with few bits set or clear.
    [[nodiscard]] std::uint32_t word();
    /// In [0, count).
    [[nodiscard]] std::uint32_t index(std::uint32_t count) { return next() % count; }
    [[nodiscard]] bool chance(std::uint32_t oneIn) { return index(oneIn) == 0; }
    /// In [0, 1).
    [[nodiscard]] float unit() { return static_cast<float>(next() >> 8) * 0x1p-24f; }

    /// Mostly in [-10, 10]; also zeros of both signs, small integers, powers of two, and magnitudes from 2^-20 to 2^20:
    /// what the functions make of these is far from subnormal.
    [[nodiscard]] float coordinate();
    [[nodiscard]] glm::vec3 point();
    /// Of unit length except for rounding; often along an axis or in a plane of axes, with zeros of both signs.
    [[nodiscard]] glm::vec3 direction();
    /// A direction from `origin` to `target`, or any where they coincide.
    [[nodiscard]] glm::vec3 towards(const glm::vec3 &origin, const glm::vec3 &target);

  private:
    std::uint32_t next() { return static_cast<std::uint32_t>(generator_()); }

    std::mt19937 generator_{seed}; // the same numbers on every machine, unlike the distributions
};

} // namespace hyalite::core::testing
