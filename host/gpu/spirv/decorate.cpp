#include "host/gpu/spirv/decorate.h"

#include "host/gpu/spirv/instructions.h"

#include <spirv/unified1/GLSL.std.450.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace hyalite::core::gpu {

namespace {

/// GLSL.std.450 instructions with exact results, and sqrt.
constexpr std::array allowedInstructions{
    GLSLstd450FAbs,   GLSLstd450SAbs,     GLSLstd450Floor,    GLSLstd450Sqrt,
    GLSLstd450FMin,   GLSLstd450UMin,     GLSLstd450SMin,     GLSLstd450FMax,
    GLSLstd450UMax,   GLSLstd450SMax,     GLSLstd450FClamp,   GLSLstd450UClamp,
    GLSLstd450SClamp, GLSLstd450FindILsb, GLSLstd450FindSMsb, GLSLstd450FindUMsb};

struct RefusedInstruction {
    std::uint32_t number;
    const char *name;
};

/// The rejected instructions that shaders are most likely to use, with their names for messages.
constexpr std::array<RefusedInstruction, 12> refusedInstructions{{{GLSLstd450Fma, "fma"},
                                                                  {GLSLstd450FMix, "mix"},
                                                                  {GLSLstd450Normalize, "normalize"},
                                                                  {GLSLstd450Length, "length"},
                                                                  {GLSLstd450Distance, "distance"},
                                                                  {GLSLstd450Cross, "cross"},
                                                                  {GLSLstd450Reflect, "reflect"},
                                                                  {GLSLstd450Refract, "refract"},
                                                                  {GLSLstd450SmoothStep, "smoothstep"},
                                                                  {GLSLstd450InverseSqrt, "inversesqrt"},
                                                                  {GLSLstd450Pow, "pow"},
                                                                  {GLSLstd450Exp, "exp"}}};

/// The name of an operation without a fixed order, or null.
const char *refusedOperation(spv::Op opcode) {
    switch (opcode) {
    case spv::Op::OpDot:
        return "OpDot";
    case spv::Op::OpVectorTimesMatrix:
    case spv::Op::OpMatrixTimesVector:
    case spv::Op::OpMatrixTimesMatrix:
    case spv::Op::OpMatrixTimesScalar:
    case spv::Op::OpOuterProduct:
        return "a product with a matrix";
    case spv::Op::OpFRem:
    case spv::Op::OpFMod:
        return "a remainder of floats";
    default:
        return nullptr;
    }
}

std::string refusedExtended(std::uint32_t number) {
    const auto named = std::ranges::find(refusedInstructions, number, &RefusedInstruction::number);
    return named != refusedInstructions.end() ? named->name
                                              : "instruction " + std::to_string(number) + " of GLSL.std.450";
}

std::string textAt(std::span<const std::uint32_t> words) {
    std::string text;
    for (const std::uint32_t word : words)
        for (int shift = 0; shift < 32; shift += 8) {
            const char letter = static_cast<char>(word >> shift & 0xFF);
            if (letter == '\0')
                return text;
            text += letter;
        }
    return text;
}

/// Throws if the module has an operation that no decoration makes exact.
void requireFixedRounding(const std::vector<SpirvInstruction> &instructions) {
    std::map<std::uint32_t, std::string> names;
    std::string function;
    for (const SpirvInstruction &instruction : instructions) {
        if (instruction.opcode() == spv::Op::OpName)
            names[instruction.words[1]] = textAt(instruction.words.subspan(2));
        if (instruction.opcode() == spv::Op::OpFunction)
            function = names[instruction.result()];
        std::string refused;
        if (const char *operation = refusedOperation(instruction.opcode()))
            refused = operation;
        else if (instruction.opcode() == spv::Op::OpExtInst &&
                 std::ranges::find(allowedInstructions, instruction.words[4]) == allowedInstructions.end())
            refused = refusedExtended(instruction.words[4]);
        if (!refused.empty())
            throw std::invalid_argument(
                refused + " in " + function +
                " has no fixed order or rounding: write it with + - * and the functions of "
                "shaders/math");
    }
}

} // namespace

bool isRoundedOperation(std::uint32_t opcode) {
    switch (static_cast<spv::Op>(opcode)) {
    case spv::Op::OpFAdd:
    case spv::Op::OpFSub:
    case spv::Op::OpFMul:
    case spv::Op::OpFDiv:
    case spv::Op::OpFNegate:
    case spv::Op::OpVectorTimesScalar:
        return true;
    default:
        return false;
    }
}

std::vector<std::uint32_t> decorateNoContraction(std::span<const std::uint32_t> spirv) {
    const std::vector<SpirvInstruction> instructions = instructionsOf(spirv);
    requireFixedRounding(instructions);
    std::vector<bool> isDecorated(spirv[spirvBoundWord]);
    for (const SpirvInstruction &instruction : instructions)
        if (instruction.opcode() == spv::Op::OpDecorate &&
            instruction.words[2] == static_cast<std::uint32_t>(spv::Decoration::NoContraction))
            isDecorated[instruction.words[1]] = true;
    std::vector<std::uint32_t> words(spirv.begin(), spirv.begin() + spirvHeaderWords);
    bool isBeforeTypes = true;
    for (const SpirvInstruction &instruction : instructions) {
        // Decorations stand before the first type (section 2.4).
        if (isBeforeTypes && instruction.opcode() >= spv::Op::OpTypeVoid &&
            instruction.opcode() <= spv::Op::OpTypeForwardPointer) {
            isBeforeTypes = false;
            for (const SpirvInstruction &operation : instructions)
                if (isRoundedOperation(static_cast<std::uint32_t>(operation.opcode())) &&
                    !isDecorated[operation.result()])
                    append(words, spv::Op::OpDecorate,
                           {operation.result(), static_cast<std::uint32_t>(spv::Decoration::NoContraction)});
        }
        words.insert(words.end(), instruction.words.begin(), instruction.words.end());
    }
    return words;
}

} // namespace hyalite::core::gpu
