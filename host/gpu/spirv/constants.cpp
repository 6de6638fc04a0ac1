#include "host/gpu/spirv/constants.h"

namespace hyalite::core::gpu {

SpirvValue evaluate(spv::Op opcode, const std::array<SpirvValue, 3> &operands) {
    const auto &[a, b, c] = operands;
    switch (opcode) {
    case spv::Op::OpLogicalAnd:
        return a == 0u || b == 0u ? SpirvValue(0u) : (a && b ? SpirvValue(1u) : SpirvValue());
    case spv::Op::OpLogicalOr:
        return a == 1u || b == 1u ? SpirvValue(1u) : (a && b ? SpirvValue(0u) : SpirvValue());
    case spv::Op::OpSelect:
        return a ? (*a != 0 ? b : c) : SpirvValue();
    case spv::Op::OpLogicalNot:
        return a ? SpirvValue(*a == 0) : SpirvValue();
    case spv::Op::OpNot:
        return a ? SpirvValue(~*a) : SpirvValue();
    default:
        break;
    }
    if (!a || !b)
        return {};
    const std::uint32_t x = *a;
    const std::uint32_t y = *b;
    switch (opcode) {
    case spv::Op::OpIAdd:
        return x + y;
    case spv::Op::OpISub:
        return x - y;
    case spv::Op::OpIMul:
        return x * y;
    case spv::Op::OpUDiv:
        return y != 0 ? x / y : 0; // undefined in SPIR-V
    case spv::Op::OpShiftRightLogical:
        return y < 32 ? x >> y : 0; // likewise
    case spv::Op::OpBitwiseAnd:
        return x & y;
    case spv::Op::OpBitwiseOr:
        return x | y;
    case spv::Op::OpIEqual:
    case spv::Op::OpLogicalEqual:
        return x == y;
    case spv::Op::OpINotEqual:
    case spv::Op::OpLogicalNotEqual:
        return x != y;
    case spv::Op::OpULessThan:
        return x < y;
    case spv::Op::OpULessThanEqual:
        return x <= y;
    case spv::Op::OpUGreaterThan:
        return x > y;
    case spv::Op::OpUGreaterThanEqual:
        return x >= y;
    default:
        return {};
    }
}

std::array<SpirvValue, 3> operandsOf(std::span<const std::uint32_t> words, std::size_t first,
                                     const std::vector<SpirvValue> &known) {
    std::array<SpirvValue, 3> operands{};
    for (std::size_t i = 0; i < operands.size() && first + i < words.size(); ++i)
        operands[i] = words[first + i] < known.size() ? known[words[first + i]] : SpirvValue();
    return operands;
}

std::vector<SpirvValue> knownConstants(std::span<const SpirvInstruction> instructions, std::uint32_t bound,
                                       std::span<const std::uint32_t> constants) {
    std::vector<SpirvValue> known(bound);
    std::vector<std::uint32_t> number(bound, ~0u); // of specialization constants
    const auto given = [&](std::uint32_t id, std::uint32_t byDefault) {
        return number[id] < constants.size() ? constants[number[id]] : byDefault;
    };
    for (const SpirvInstruction &instruction : instructions) {
        const std::span<const std::uint32_t> words = instruction.words;
        switch (instruction.opcode()) {
        case spv::Op::OpDecorate:
            if (words[2] == static_cast<std::uint32_t>(spv::Decoration::SpecId))
                number[words[1]] = words[3];
            break;
        case spv::Op::OpConstantTrue:
            known[words[2]] = 1;
            break;
        case spv::Op::OpConstantFalse:
            known[words[2]] = 0;
            break;
        case spv::Op::OpSpecConstantTrue:
        case spv::Op::OpSpecConstantFalse:
            known[words[2]] = given(words[2], instruction.opcode() == spv::Op::OpSpecConstantTrue) != 0;
            break;
        case spv::Op::OpConstant:
            if (words.size() == 4) // wider constants take two words
                known[words[2]] = words[3];
            break;
        case spv::Op::OpSpecConstant:
            if (words.size() == 4)
                known[words[2]] = given(words[2], words[3]);
            break;
        case spv::Op::OpSpecConstantOp:
            known[words[2]] = evaluate(static_cast<spv::Op>(words[3]), operandsOf(words, 4, known));
            break;
        case spv::Op::OpFunction:
            return known;
        default:
            break;
        }
    }
    return known;
}

} // namespace hyalite::core::gpu
