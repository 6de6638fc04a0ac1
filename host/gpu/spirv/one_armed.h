// Selections with two arms as two selections with one arm each.
//
//   if (c) A else B   ->   if (c) A; if (!c) B
//
// SwiftShader's compiler takes time that doubles with each two-armed selection in a loop: ten take 0.02 s, 25 more than
// 5 s, and kernels have up to a hundred. With one-armed selections its time is linear. On lavapipe 22.3.6 and 25.0.7
// the frames of the shipped scenes take as long in either form (tests/bench/README.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// The module `spirv` with each conditional selection of two arms rewritten; switches and loops stay. It computes the
/// same values, and evaluates no condition anew. `spirv` is a valid module whose blocks are in the order of their
/// constructs, as specialise() writes it.
[[nodiscard]] std::vector<std::uint32_t> makeSelectionsOneArmed(std::span<const std::uint32_t> spirv);

} // namespace hyalite::core::gpu
