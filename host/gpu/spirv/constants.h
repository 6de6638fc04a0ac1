// Known constant values of a SPIR-V module.
#pragma once

#include "host/gpu/spirv/instructions.h"

#include <array>
#include <optional>

namespace hyalite::gpu {

/// Of a boolean (0 or 1) or of another scalar of 32 bits, if it is known.
using SpirvValue = std::optional<std::uint32_t>;

/// The result of an operation on booleans or integers of 32 bits whose operands may be known: nothing where that is not
/// enough, or for other operations.
[[nodiscard]] SpirvValue evaluate(spv::Op opcode, const std::array<SpirvValue, 3> &operands);

/// What `known` says, by id, of the three words from `first` on; words may be missing or be no ids.
[[nodiscard]] std::array<SpirvValue, 3> operandsOf(std::span<const std::uint32_t> words, std::size_t first,
                                                   const std::vector<SpirvValue> &known);

/// By id, what the scalar constants of a module with ids below `bound` are where its specialization constants 0, 1, ...
/// have these values (booleans: whether it is not 0), and others their defaults.
[[nodiscard]] std::vector<SpirvValue> knownConstants(std::span<const SpirvInstruction> instructions,
                                                     std::uint32_t bound,
                                                     std::span<const std::uint32_t> constants);

} // namespace hyalite::gpu
