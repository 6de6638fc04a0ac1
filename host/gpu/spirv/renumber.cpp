#include "host/gpu/spirv/renumber.h"

#include "host/gpu/spirv/instructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace hyalite::core::gpu {

namespace {

/// The operands of instructions, a letter each: i for an id, and l for a literal or a part of a text. The last one holds
/// for all that follow; empty: not known. SPIR-V specification, section 3.42.
constexpr auto operandTable = [] {
    using enum spv::Op;
    std::array<std::string_view, 512> table{};
    const auto set = [&](std::string_view letters, std::initializer_list<spv::Op> opcodes) {
        for (const spv::Op opcode : opcodes)
            table[static_cast<std::size_t>(opcode)] = letters;
    };
    set("l", {OpCapability, OpExtension, OpMemoryModel, OpSource, OpModuleProcessed, OpSourceExtension});
    set("il", {OpExtInstImport, OpExecutionMode, OpName, OpMemberName, OpDecorate, OpMemberDecorate,
               OpTypeInt, OpTypeFloat, OpSelectionMerge});
    set("iil", {OpTypeVector, OpTypeImage, OpConstant, OpSpecConstant, OpStore, OpLoopMerge});
    set("iiil", {OpLoad, OpCompositeExtract, OpArrayLength, OpBranchConditional});
    set("iiiil", {OpCompositeInsert, OpVectorShuffle});
    set("ili", {OpTypePointer});
    set("iili", {OpVariable, OpFunction});
    set("iiili", {OpExtInst, OpImageWrite, OpGroupNonUniformIAdd, OpGroupNonUniformUMax});
    set("iiiili", {OpImageRead});
    set("i", {OpTypeVoid, OpTypeBool, OpTypeArray, OpTypeRuntimeArray, OpTypeStruct, OpTypeFunction,
              OpConstantTrue, OpConstantFalse, OpConstantComposite});
    set("i", {OpSpecConstantTrue, OpSpecConstantFalse, OpSpecConstantComposite, OpConstantNull, OpUndef,
              OpFunctionParameter, OpFunctionEnd, OpFunctionCall, OpLabel});
    set("i", {OpBranch, OpPhi, OpReturn, OpReturnValue, OpUnreachable, OpKill, OpAccessChain,
              OpInBoundsAccessChain, OpCopyObject});
    set("i",
        {OpVectorExtractDynamic, OpVectorInsertDynamic, OpCompositeConstruct, OpSelect, OpVectorTimesScalar,
         OpControlBarrier, OpMemoryBarrier, OpGroupNonUniformElect, OpGroupNonUniformAny});
    set("i", {OpGroupNonUniformAll, OpGroupNonUniformBallot, OpGroupNonUniformBroadcast,
              OpGroupNonUniformShuffle, OpGroupNonUniformShuffleXor});
    // Conversions, arithmetic, comparisons, bits and atomics: blocks of the table that have ids only.
    for (const auto &[first, last] :
         {std::pair(OpConvertFToU, OpUConvert), std::pair(OpBitcast, OpBitcast), std::pair(OpSNegate, OpFMod),
          std::pair(OpAny, OpBitCount), std::pair(OpAtomicLoad, OpAtomicXor)})
        for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i)
            table[i] = "i";
    return table;
}();

/// Whether it is one of SPV_KHR_ray_query that kernels use. All have ids only.
bool isOfRayQueries(spv::Op opcode) {
    using enum spv::Op;
    return opcode == OpTypeAccelerationStructureKHR ||
           (opcode >= OpTypeRayQueryKHR && opcode <= OpRayQueryProceedKHR) ||
           opcode == OpRayQueryGetIntersectionGeometryIndexKHR ||
           opcode == OpRayQueryGetIntersectionPrimitiveIndexKHR;
}

std::string_view operandsOf(spv::Op opcode) {
    const auto i = static_cast<std::size_t>(opcode);
    if (isOfRayQueries(opcode))
        return "i";
    return i < operandTable.size() ? operandTable[i] : std::string_view();
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
                fmt::format("operands of the SPIR-V instruction {} are unknown: tell operandTable in "
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
