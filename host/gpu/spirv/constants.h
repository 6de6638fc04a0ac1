// Known constant values of a SPIR-V module.
#pragma once

#include "host/gpu/spirv/instructions.h"

#include <array>
#include <optional>

namespace hyalite::core::gpu {

/// The value of a boolean (0 or 1) or of another 32-bit scalar; empty if unknown.
using SpirvValue = std::optional<std::uint32_t>;

/// The result of an operation on booleans or 32-bit integers. Operands may be unknown. Empty if the known ones do not
/// determine the result, and for other operations.
[[nodiscard]] SpirvValue evaluate(spv::Op opcode, const std::array<SpirvValue, 3> &operands);

/// The values in `known` of the ids in the three words from `first` on. A missing word, or one that is not an id, is
/// unknown.
[[nodiscard]] std::array<SpirvValue, 3> operandsOf(std::span<const std::uint32_t> words, std::size_t first,
                                                   const std::vector<SpirvValue> &known);

/// The values of the scalar constants of a module, by id; all ids are below `bound`. The specialization constants 0, 1,
/// ... have the values in `constants` (a boolean is true unless its word is 0); others have their defaults.
[[nodiscard]] std::vector<SpirvValue> knownConstants(std::span<const SpirvInstruction> instructions,
                                                     std::uint32_t bound,
                                                     std::span<const std::uint32_t> constants);

} // namespace hyalite::core::gpu
