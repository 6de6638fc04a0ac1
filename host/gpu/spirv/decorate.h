// NoContraction on every float operation of a module; operations without a fixed order or rounding are rejected.
//
// Shaders are written without `precise`. The build decorates the output of glslang before any optimiser runs. Neither
// spirv-opt nor a driver may then fuse, reorder or drop an operation, so kernels round as the CPU twin does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// The module `spirv` with each of its float additions, subtractions, multiplications, divisions and negations
/// decorated NoContraction (SPIR-V specification, section 3.20). All else stays as it is. Throws std::invalid_argument,
/// with the instruction and the function that it stands in, for operations whose order or rounding no decoration fixes:
/// OpDot, products with matrices, remainders, and the instructions of GLSL.std.450 that are not exact, such as fma,
/// mix, normalize, length, cross and reflect. `sqrt` is allowed: a kernel uses the device's own only where the host has
/// found it correctly rounded.
[[nodiscard]] std::vector<std::uint32_t> decorateNoContraction(std::span<const std::uint32_t> spirv);

/// Whether decorateNoContraction() decorates the results of this kind of instruction; `opcode` is an spv::Op.
[[nodiscard]] bool isRoundedOperation(std::uint32_t opcode);

} // namespace hyalite::core::gpu
