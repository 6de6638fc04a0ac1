// A kernel's SPIR-V for known specialization constants, without the code that they rule out.
//
// A driver takes specialization constants as well, but reads, inlines and lowers a whole module before it drops what they
// rule out, and most of our kernels' code is for features that a scene does not use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::gpu {

/// The module `spirv` with the specialization constants 0, 1, ... set to `constants`, in the way of Vulkan (a boolean is
/// true where its word is not 0); constants beyond these keep their defaults. Blocks go that only selections lead to whose
/// conditions follow from them (spirv_blocks.h says which), and no specialization constant is left but for operations that
/// spirv_constants.h does not know. `spirv` is a valid module for Vulkan in the byte order of this machine, as glslang
/// writes it: blocks in the order of their constructs, scalars of 32 bits, no decorations but OpDecorate, no debug lines.
[[nodiscard]] std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> spirv,
                                                    std::span<const std::uint32_t> constants);

} // namespace hyalite::gpu
