// SPIR-V specialization: fixes a kernel's specialization constants and removes the code they make unreachable.
//
// A driver also accepts specialization constants, but it parses, inlines and lowers the whole module before it removes
// dead code. Most kernel code serves features that a given scene does not use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// The module `spirv` with the specialization constants 0, 1, ... set to `constants`, as Vulkan sets them (a boolean is
/// true unless its word is 0). Constants beyond these keep their defaults.
///
/// Blocks that the resolved selections (blocks.h) make unreachable are removed. The only specialization constants left
/// are those computed by operations that constants.h does not know.
///
/// `spirv` is a valid module for Vulkan in the byte order of this machine, as glslang writes it: blocks in the order of
/// their constructs, 32-bit scalars, no decorations except OpDecorate, no debug lines.
[[nodiscard]] std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> spirv,
                                                    std::span<const std::uint32_t> constants);

} // namespace hyalite::core::gpu
