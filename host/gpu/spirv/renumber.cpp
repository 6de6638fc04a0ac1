#include "host/gpu/spirv/renumber.h"

#include "host/gpu/spirv/instructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace hyalite::core::gpu {

namespace {

/// The operands of an instruction, a letter each: i for an id, and l for a literal or a part of a text. The last one
/// holds for all that follow. SPIR-V specification, section 3.42.
std::string_view operandsOf(spv::Op opcode) {
    switch (opcode) {
    case spv::Op::OpCapability:
    case spv::Op::OpExtension:
    case spv::Op::OpMemoryModel:
    case spv::Op::OpSource:
    case spv::Op::OpModuleProcessed:
    case spv::Op::OpSourceExtension:
        return "l";
    case spv::Op::OpExtInstImport:
    case spv::Op::OpExecutionMode:
    case spv::Op::OpName:
    case spv::Op::OpMemberName:
    case spv::Op::OpDecorate:
    case spv::Op::OpMemberDecorate:
    case spv::Op::OpTypeInt:
    case spv::Op::OpTypeFloat:
    case spv::Op::OpSelectionMerge:
        return "il";
    case spv::Op::OpTypeVector:
    case spv::Op::OpTypeImage:
    case spv::Op::OpConstant:
    case spv::Op::OpSpecConstant:
    case spv::Op::OpStore:
    case spv::Op::OpLoopMerge:
        return "iil";
    case spv::Op::OpLoad:
    case spv::Op::OpCompositeExtract:
    case spv::Op::OpArrayLength:
    case spv::Op::OpBranchConditional:
        return "iiil";
    case spv::Op::OpCompositeInsert:
    case spv::Op::OpVectorShuffle:
        return "iiiil";
    case spv::Op::OpTypePointer:
        return "ili";
    case spv::Op::OpVariable:
    case spv::Op::OpFunction:
        return "iili";
    case spv::Op::OpExtInst:
    case spv::Op::OpImageWrite:
    case spv::Op::OpGroupNonUniformIAdd:
    case spv::Op::OpGroupNonUniformUMax:
        return "iiili";
    case spv::Op::OpImageRead:
        return "iiiili";
    case spv::Op::OpTypeVoid:
    case spv::Op::OpTypeBool:
    case spv::Op::OpTypeArray:
    case spv::Op::OpTypeRuntimeArray:
    case spv::Op::OpTypeStruct:
    case spv::Op::OpTypeFunction:
    case spv::Op::OpConstantTrue:
    case spv::Op::OpConstantFalse:
    case spv::Op::OpConstantComposite:
    case spv::Op::OpSpecConstantTrue:
    case spv::Op::OpSpecConstantFalse:
    case spv::Op::OpSpecConstantComposite:
    case spv::Op::OpConstantNull:
    case spv::Op::OpUndef:
    case spv::Op::OpFunctionParameter:
    case spv::Op::OpFunctionEnd:
    case spv::Op::OpFunctionCall:
    case spv::Op::OpLabel:
    case spv::Op::OpBranch:
    case spv::Op::OpPhi:
    case spv::Op::OpReturn:
    case spv::Op::OpReturnValue:
    case spv::Op::OpUnreachable:
    case spv::Op::OpKill:
    case spv::Op::OpAccessChain:
    case spv::Op::OpInBoundsAccessChain:
    case spv::Op::OpCopyObject:
    case spv::Op::OpVectorExtractDynamic:
    case spv::Op::OpVectorInsertDynamic:
    case spv::Op::OpCompositeConstruct:
    case spv::Op::OpSelect:
    case spv::Op::OpVectorTimesScalar:
    case spv::Op::OpControlBarrier:
    case spv::Op::OpMemoryBarrier:
    case spv::Op::OpGroupNonUniformElect:
    case spv::Op::OpGroupNonUniformAny:
    case spv::Op::OpGroupNonUniformAll:
    case spv::Op::OpGroupNonUniformBallot:
    case spv::Op::OpGroupNonUniformBroadcast:
    case spv::Op::OpGroupNonUniformShuffle:
    case spv::Op::OpGroupNonUniformShuffleXor:
        return "i";
    default:
        break;
    }
    // Conversions, arithmetic, comparisons, bits and atomics: blocks of the table that have ids only.
    const auto isBetween = [&](spv::Op first, spv::Op last) { return first <= opcode && opcode <= last; };
    if (isBetween(spv::Op::OpConvertFToU, spv::Op::OpUConvert) || opcode == spv::Op::OpBitcast ||
        isBetween(spv::Op::OpSNegate, spv::Op::OpFMod) || isBetween(spv::Op::OpAny, spv::Op::OpBitCount) ||
        isBetween(spv::Op::OpAtomicLoad, spv::Op::OpAtomicXor))
        return "i";
    return {};
}

class Numbers {
  public:
    explicit Numbers(std::uint32_t bound) : numbers_(bound) {}

    void renumber(std::uint32_t &id) {
        if (id >= numbers_.size())
            throw std::invalid_argument(fmt::format("the SPIR-V id {} is not below the bound", id));
        if (numbers_[id] == 0)
            numbers_[id] = next_++;
        id = numbers_[id];
    }
    /// An upper bound of all numbers.
    [[nodiscard]] std::uint32_t bound() const { return next_; }

  private:
    std::vector<std::uint32_t> numbers_; // by id; 0: none yet
    std::uint32_t next_ = 1;
};

/// An entry point: a literal, an id, a text that ends with a zero byte, and ids.
void renumberEntryPoint(std::span<std::uint32_t> operands, Numbers &numbers) {
    numbers.renumber(operands[1]);
    const auto hasZero = [](std::uint32_t word) {
        return (word & 0xFFu) == 0 || (word & 0xFF00u) == 0 || (word & 0xFF0000u) == 0 || (word >> 24) == 0;
    };
    const auto textEnd = std::find_if(operands.begin() + 2, operands.end(), hasZero);
    for (auto id = textEnd + (textEnd != operands.end()); id != operands.end(); ++id)
        numbers.renumber(*id);
}

/// A switch: two ids, and then a literal and an id for each case.
void renumberSwitch(std::span<std::uint32_t> operands, Numbers &numbers) {
    numbers.renumber(operands[0]);
    for (std::size_t i = 1; i < operands.size(); i += 2)
        numbers.renumber(operands[i]);
}

/// An operation on constants: type, result, opcode, and the operands of that.
void renumberConstantOperation(std::span<std::uint32_t> operands, Numbers &numbers) {
    const auto opcode = static_cast<spv::Op>(operands[2]);
    if (operandsOf(opcode) != "i")
        throw std::invalid_argument(fmt::format("a SPIR-V constant of the operation {}", operands[2]));
    for (std::size_t i = 0; i < operands.size(); ++i)
        if (i != 2)
            numbers.renumber(operands[i]);
}

} // namespace

std::vector<std::uint32_t> renumber(std::span<const std::uint32_t> spirv) {
    const std::vector<SpirvInstruction> instructions = instructionsOf(spirv);
    std::vector<std::uint32_t> words(spirv.begin(), spirv.end());
    Numbers numbers(words[spirvBoundWord]);
    for (const SpirvInstruction &instruction : instructions) {
        const auto begin = static_cast<std::size_t>(instruction.words.data() - spirv.data());
        const std::span<std::uint32_t> operands =
            std::span(words).subspan(begin + 1, instruction.words.size() - 1);
        switch (instruction.opcode()) {
        case spv::Op::OpEntryPoint:
            renumberEntryPoint(operands, numbers);
            continue;
        case spv::Op::OpSwitch:
            renumberSwitch(operands, numbers);
            continue;
        case spv::Op::OpSpecConstantOp:
            renumberConstantOperation(operands, numbers);
            continue;
        default:
            break;
        }
        const std::string_view letters = operandsOf(instruction.opcode());
        if (letters.empty())
            throw std::invalid_argument(
                fmt::format("operands of the SPIR-V instruction {} are unknown: tell operandsOf() in "
                            "host/gpu/spirv/renumber.cpp",
                            static_cast<int>(instruction.opcode())));
        for (std::size_t i = 0; i < operands.size(); ++i)
            if (letters[std::min(i, letters.size() - 1)] == 'i')
                numbers.renumber(operands[i]);
    }
    words[spirvBoundWord] = numbers.bound();
    return words;
}

} // namespace hyalite::core::gpu
