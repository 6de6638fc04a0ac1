// Ids of a SPIR-V module without gaps. Drivers make an array of all ids up to the bound, a hundred bytes each;
// spirv-opt leaves one id in four of a kernel, and specialise() one in twelve of these.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// The module `spirv` with its ids numbered 1, 2, ... in the order of their first mention; all else stays. `spirv` is a
/// valid module for Vulkan 1.1 without debug lines, 64-bit switches and the Vulkan memory model. Throws
/// std::invalid_argument for instructions whose operands it does not know; the build sees all kernels go through it.
[[nodiscard]] std::vector<std::uint32_t> renumber(std::span<const std::uint32_t> spirv);

} // namespace hyalite::core::gpu
