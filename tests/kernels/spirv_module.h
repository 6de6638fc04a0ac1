// SPIR-V modules as lists of instructions.
#pragma once

#include "host/gpu/spirv/instructions.h"

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core::testing {

struct Instruction {
    spv::Op opcode;
    std::span<const std::uint32_t> operands; ///< all words but the first
    std::string function;                    ///< where it stands: "divide(f1;f1;", empty outside of functions
};

/// The parts of the SPIR-V 1.3 specification that the tests speak about.
struct SpirvModule {
    /// Throws as gpu::instructionsOf does.
    explicit SpirvModule(std::span<const std::uint32_t> words);

    std::vector<Instruction> instructions;
    std::set<std::uint32_t> uncontracted; ///< results decorated NoContraction
};

} // namespace hyalite::core::testing
