#include "host/gpu/spirv/specialise.h"

#include "host/gpu/spirv/blocks.h"

#include <algorithm>

namespace hyalite::core::gpu {

namespace {

class Specialiser {
  public:
    Specialiser(std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> constants)
        : spirv_(spirv), bound_(spirv[spirvBoundWord]), instructions_(instructionsOf(spirv)),
          known_(knownConstants(instructions_, bound_, constants)), blocks_(instructions_, known_),
          isDefined_(bound_), isUndecided_(bound_) {}

    std::vector<std::uint32_t> write() {
        const auto isFunction = [](const SpirvInstruction &instruction) {
            return instruction.opcode() == spv::Op::OpFunction;
        };
        const auto firstFunction = std::ranges::find_if(instructions_, isFunction);
        const std::span declarations(instructions_.begin(), firstFunction);
        const std::vector<std::uint32_t> code = writtenCode({firstFunction, instructions_.end()});
        for (const SpirvInstruction &instruction : declarations) {
            define(instruction.result());
            if (instruction.opcode() == spv::Op::OpTypeBool)
                boolType_ = instruction.result();
        }
        std::vector<std::uint32_t> words(spirv_.begin(), spirv_.begin() + spirvHeaderWords);
        for (const SpirvInstruction &instruction : declarations)
            if (!isIdle(instruction))
                writeDeclaration(words, instruction);
        words.insert(words.end(), undefined_.begin(), undefined_.end());
        words.insert(words.end(), code.begin(), code.end());
        words[spirvBoundWord] = bound_;
        return words;
    }

  private:
    void define(std::uint32_t id) {
        if (id != 0)
            isDefined_[id] = true;
    }

    void copy(std::vector<std::uint32_t> &words, const SpirvInstruction &instruction) {
        words.insert(words.end(), instruction.words.begin(), instruction.words.end());
        define(instruction.result());
    }

    void writeDeclaration(std::vector<std::uint32_t> &words, const SpirvInstruction &instruction) {
        const std::uint32_t id = instruction.result();
        switch (instruction.opcode()) {
        case spv::Op::OpSpecConstantComposite:
            if (std::ranges::none_of(instruction.words.subspan(3),
                                     [&](auto part) { return isUndecided_[part]; })) {
                append(words, spv::Op::OpConstantComposite, instruction.words.subspan(1));
                return;
            }
            isUndecided_[id] = true;
            break;
        case spv::Op::OpSpecConstantTrue:
        case spv::Op::OpSpecConstantFalse:
        case spv::Op::OpSpecConstant:
        case spv::Op::OpSpecConstantOp:
            if (known_[id]) {
                const std::uint32_t type = instruction.words[1];
                if (type == boolType_)
                    append(words, *known_[id] != 0 ? spv::Op::OpConstantTrue : spv::Op::OpConstantFalse,
                           {type, id});
                else
                    append(words, spv::Op::OpConstant, {type, id, *known_[id]});
                return;
            }
            isUndecided_[id] = true;
            break;
        default:
            break;
        }
        copy(words, instruction);
    }

    /// Writes a phi without its removed incoming edges. If the continue target of a loop is never reached, its incoming
    /// value is undefined.
    void writePhi(std::vector<std::uint32_t> &words, const SpirvBlock &block,
                  std::span<const std::uint32_t> phi) {
        std::vector<std::uint32_t> operands{phi[1], phi[2]};
        for (std::size_t i = 3; i + 1 < phi.size(); i += 2) {
            const SpirvBlock &from = blocks_.at(phi[i + 1]);
            if (blocks_.isEdge(from.label, block.label)) {
                operands.insert(operands.end(), {phi[i], phi[i + 1]});
            } else if (from.continuedLoop == block.label && !blocks_.at(block.continueTarget).isReached) {
                append(undefined_, spv::Op::OpUndef, {phi[1], bound_});
                operands.insert(operands.end(), {bound_++, block.continueTarget});
            }
        }
        append(words, spv::Op::OpPhi, operands);
        define(phi[2]);
    }

    void writeBlock(std::vector<std::uint32_t> &words, const SpirvBlock &block) {
        copy(words, instructions_[block.begin]);
        if (!block.isReached) {
            const std::uint32_t loop = block.continuedLoop;
            if (loop != 0 && blocks_.at(loop).continueTarget == block.label)
                append(words, spv::Op::OpBranch, {loop});
            else
                append(words, spv::Op::OpUnreachable, {});
            return;
        }
        // The merge instruction and the branch.
        const std::size_t end = block.only != 0 ? block.end - 2 : block.end;
        for (std::size_t i = block.begin + 1; i < end; ++i)
            if (instructions_[i].opcode() == spv::Op::OpPhi)
                writePhi(words, block, instructions_[i].words);
            else
                copy(words, instructions_[i]);
        if (block.only != 0)
            append(words, spv::Op::OpBranch, {block.only});
    }

    std::vector<std::uint32_t> writtenCode(std::span<const SpirvInstruction> functions) {
        std::vector<std::uint32_t> words;
        bool isGone = false;
        for (const SpirvInstruction &instruction : functions) {
            if (instruction.opcode() == spv::Op::OpFunctionEnd)
                isGone = false;
            if (instruction.opcode() == spv::Op::OpLabel) {
                isGone = true; // or written as a whole
                if (blocks_.isNeeded(instruction.words[1]))
                    writeBlock(words, blocks_.at(instruction.words[1]));
            }
            if (!isGone)
                copy(words, instruction);
        }
        return words;
    }

    /// Whether to omit the instruction: it names or decorates a removed id, or it is a SpecId decoration.
    [[nodiscard]] bool isIdle(const SpirvInstruction &instruction) const {
        switch (instruction.opcode()) {
        case spv::Op::OpDecorate:
            if (instruction.words[2] == static_cast<std::uint32_t>(spv::Decoration::SpecId))
                return true;
            [[fallthrough]];
        case spv::Op::OpName:
            return !isDefined_[instruction.words[1]];
        default:
            return false;
        }
    }

    std::span<const std::uint32_t> spirv_;
    std::uint32_t bound_;
    std::vector<SpirvInstruction> instructions_;
    std::vector<SpirvValue> known_; // by id: constants
    SpirvBlocks blocks_;
    std::uint32_t boolType_ = 0;
    std::vector<bool> isDefined_;          // by id: defined in the output
    std::vector<bool> isUndecided_;        // by id: constants that stay for specialization
    std::vector<std::uint32_t> undefined_; // OpUndef instructions, for phis
};

} // namespace

std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> spirv,
                                      std::span<const std::uint32_t> constants) {
    return Specialiser(spirv, constants).write();
}

} // namespace hyalite::core::gpu
