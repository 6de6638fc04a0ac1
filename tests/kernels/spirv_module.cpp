#include "tests/kernels/spirv_module.h"

namespace hyalite::core::testing {

namespace {

/// Four characters a word, the lowest byte first, ended by a zero.
std::string readString(std::span<const std::uint32_t> words) {
    std::string text;
    for (const std::uint32_t word : words) {
        for (std::uint32_t shift = 0; shift < 32; shift += 8) {
            const char letter = static_cast<char>(word >> shift & 0xFFu);
            if (letter == '\0')
                return text;
            text += letter;
        }
    }
    return text;
}

} // namespace

SpirvModule::SpirvModule(std::span<const std::uint32_t> words) {
    std::map<std::uint32_t, std::string> names;
    std::string function;
    for (const gpu::SpirvInstruction &instruction : gpu::instructionsOf(words)) {
        const spv::Op opcode = instruction.opcode();
        const std::span<const std::uint32_t> operands = instruction.words.subspan(1);
        if (opcode == spv::Op::OpName)
            names[operands[0]] = readString(operands.subspan(1));
        if (opcode == spv::Op::OpDecorate &&
            operands[1] == static_cast<std::uint32_t>(spv::Decoration::NoContraction))
            uncontracted.insert(operands[0]);
        if (opcode == spv::Op::OpFunction)
            function = names[operands[1]];
        instructions.push_back({opcode, operands, function});
        if (opcode == spv::Op::OpFunctionEnd)
            function.clear();
    }
}

} // namespace hyalite::core::testing
