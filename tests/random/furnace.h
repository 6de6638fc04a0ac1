// Furnaces: where all light comes from around and is 1, no radiance exceeds 1, or in glass the square of its index.
#pragma once

#include "host/packing/packed_scene.h"
#include "host/scene/scene.h"

#include <glm/vec2.hpp>

namespace hyalite::core::testing {

/// Probability, at most, that gains() is true of a pixel whose mean is not above its bound.
inline constexpr double furnaceErrorRate = 1e-8;
/// What tables of the energy of microfacets may add (tests/images/README.md).
inline constexpr double furnaceAllowance = 0.003;

/// The square of the largest index of the glass in which an eye may be; 1 outside of all.
[[nodiscard]] double maxFurnaceRadiance(const PackedScene &packed);

/// Whether the mean radiance of a pixel is above its bound, maxFurnaceRadiance times 1 + furnaceAllowance, by up to
/// 2,000 samples of `path` on the CPU, each with a seed of its own. Samples are not negative, and may have any tail. A
/// product of 1 + w (x - 1) over samples x, divided by their bound, has an expectation of at most 1 if theirs is, for
/// each w in [0, 1], and so has the mean of products of several w. By Markov's and Ville's inequalities it ever reaches
/// 1 / r with a probability of at most r. (Waudby-Smith and Ramdas, "Estimating means of bounded random variables by
/// betting", J. R. Stat. Soc. B 86, 2024, section 3.)
[[nodiscard]] bool gains(const PackedScene &packed, const RenderSettings &settings, const glm::ivec2 &pixel);

} // namespace hyalite::core::testing
