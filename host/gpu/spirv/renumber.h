// Ids of a SPIR-V module without gaps. Drivers make an array of all ids up to the bound, a hundred bytes each, and what
// specialise() leaves of a kernel has 2 in 100 of its ids.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::gpu {

/// The module `spirv` with its ids numbered 1, 2, ... in the order of their first mention; all else stays. `spirv` is a
/// valid module without debug lines. Throws std::invalid_argument for instructions whose operands it does not know.
[[nodiscard]] std::vector<std::uint32_t> renumber(std::span<const std::uint32_t> spirv);

} // namespace hyalite::gpu
