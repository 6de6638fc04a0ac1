// SPIR-V modules as lists of instructions.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace hyalite::testing {

struct Instruction {
    std::uint32_t opcode;
    std::span<const std::uint32_t> operands; ///< all words but the first
    std::string function;                    ///< where it stands: "divide(f1;f1;", empty outside of functions
};

/// The parts of the SPIR-V 1.3 specification that the tests speak about.
struct SpirvModule {
    /// Throws std::runtime_error for what is not a sequence of instructions.
    explicit SpirvModule(std::span<const std::uint32_t> words);

    std::vector<Instruction> instructions;
    std::set<std::uint32_t> uncontracted; ///< results decorated NoContraction
};

namespace spirv {
constexpr std::uint32_t opName = 5;
constexpr std::uint32_t opExtension = 10;
constexpr std::uint32_t opExtInst = 12;
constexpr std::uint32_t opEntryPoint = 15;
constexpr std::uint32_t opExecutionMode = 16;
constexpr std::uint32_t opCapability = 17;
constexpr std::uint32_t opFunction = 54;
constexpr std::uint32_t opFunctionEnd = 56;
constexpr std::uint32_t opDecorate = 71;
constexpr std::uint32_t opFAdd = 129;
constexpr std::uint32_t opFSub = 131;
constexpr std::uint32_t opFDiv = 136;
constexpr std::uint32_t opFRem = 140;
constexpr std::uint32_t opFMod = 141;
constexpr std::uint32_t opMatrixTimesVector = 145; // and vector by matrix (144), matrix by matrix (146)
constexpr std::uint32_t opVectorTimesMatrix = 144;
constexpr std::uint32_t opMatrixTimesMatrix = 146;
constexpr std::uint32_t opDot = 148;
constexpr std::uint32_t decorationNoContraction = 42;
} // namespace spirv

} // namespace hyalite::testing
