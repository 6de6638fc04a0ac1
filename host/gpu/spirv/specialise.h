// SPIR-V specialization: fixes a kernel's specialization constants and removes the code they make unreachable.
//
// A driver also accepts specialization constants, but it parses, inlines and lowers the whole module before it removes
// dead code. Most kernel code serves features that a given scene does not use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::gpu {

/// The module `spirv` with the specialization constants 0, 1, ... set to `constants`, in the way of Vulkan (a boolean
/// is true where its word is not 0); constants beyond these keep their defaults. Blocks go that only selections lead to
/// whose conditions follow from them (blocks.h says which), and no specialization constant is left but for
/// operations that constants.h does not know. `spirv` is a valid module for Vulkan in the byte order of this
/// machine, as glslang writes it: blocks in the order of their constructs, scalars of 32 bits, no decorations but
/// OpDecorate, no debug lines.
[[nodiscard]] std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> spirv,
                                                    std::span<const std::uint32_t> constants);

} // namespace hyalite::gpu
