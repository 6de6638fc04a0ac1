#include "host/gpu/spirv/one_armed.h"

#include "host/gpu/spirv/instructions.h"

#include <algorithm>
#include <array>
#include <list>
#include <map>
#include <set>
#include <utility>

namespace hyalite::core::gpu {

namespace {

using Words = std::vector<std::uint32_t>;

spv::Op opcodeOf(const Words &instruction) { return static_cast<spv::Op>(instruction[0] & spv::OpCodeMask); }

Words instructionOf(spv::Op opcode, std::span<const std::uint32_t> operands) {
    Words words;
    append(words, opcode, operands);
    return words;
}

/// Instructions from a label to a terminator.
struct Block {
    std::vector<Words> instructions;

    [[nodiscard]] std::uint32_t label() const { return instructions.front()[1]; }
    [[nodiscard]] Words &terminator() { return instructions.back(); }

    /// The merge instruction before the terminator, or null.
    [[nodiscard]] Words *merge() {
        Words *before = instructions.size() < 2 ? nullptr : &instructions[instructions.size() - 2];
        const bool isMerge = before != nullptr && (opcodeOf(*before) == spv::Op::OpSelectionMerge ||
                                                   opcodeOf(*before) == spv::Op::OpLoopMerge);
        return isMerge ? before : nullptr;
    }

    /// The places of the labels of all successors in the terminator.
    [[nodiscard]] std::vector<std::uint32_t *> targets() {
        Words &last = terminator();
        std::vector<std::uint32_t *> places;
        switch (opcodeOf(last)) {
        case spv::Op::OpBranch:
            places = {&last[1]};
            break;
        case spv::Op::OpBranchConditional:
            places = {&last[2], &last[3]};
            break;
        case spv::Op::OpSwitch:
            for (std::size_t i = 2; i < last.size(); i += 2)
                places.push_back(&last[i]);
            break;
        default:
            break;
        }
        return places;
    }

    [[nodiscard]] bool branchesTo(std::uint32_t label) {
        return std::ranges::any_of(targets(), [&](const std::uint32_t *target) { return *target == label; });
    }
};

/// The blocks of a function. References to blocks stay valid when others are inserted.
class Function {
  public:
    Function(std::vector<Words> instructions, std::uint32_t &bound,
             std::map<std::uint32_t, std::uint32_t> &undefined)
        : bound_(bound), undefinedOf_(undefined) {
        for (Words &instruction : instructions) {
            if (opcodeOf(instruction) == spv::Op::OpLabel) {
                blocks_.emplace_back();
                blockAt_[instruction[1]] = &blocks_.back();
            }
            std::vector<Words> &to = opcodeOf(instruction) == spv::Op::OpFunctionEnd ? end_
                                     : blocks_.empty()                               ? declaration_
                                                       : blocks_.back().instructions;
            to.push_back(std::move(instruction));
        }
        for (Block &header : blocks_)
            makeOneArmed(header);
    }

    void write(Words &words) const {
        const auto copy = [&](const std::vector<Words> &instructions) {
            for (const Words &instruction : instructions)
                words.insert(words.end(), instruction.begin(), instruction.end());
        };
        copy(declaration_);
        for (const Block &block : blocks_)
            copy(block.instructions);
        copy(end_);
    }

  private:
    /// The blocks that go from an arm straight to the merge block of its selection. Constructs within the arm are
    /// passed from their header to their merge block: only to leave a loop or a switch do branches go further out, and
    /// the arm's selection is neither.
    std::set<Block *> lastOfArm(std::uint32_t arm, std::uint32_t merge) {
        std::set<Block *> last;
        std::set<std::uint32_t> met{merge};
        std::vector<std::uint32_t> labels{arm};
        while (!labels.empty()) {
            const std::uint32_t label = labels.back();
            labels.pop_back();
            if (!met.insert(label).second)
                continue;
            Block &block = *blockAt_.at(label);
            if (const Words *inner = block.merge()) {
                labels.push_back((*inner)[1]);
                continue;
            }
            if (block.branchesTo(merge))
                last.insert(&block);
            for (const std::uint32_t *target : block.targets())
                labels.push_back(*target);
        }
        return last;
    }

    /// A value of this type that nothing reads.
    std::uint32_t undefinedOf(std::uint32_t type) {
        if (!undefinedOf_.contains(type))
            undefinedOf_[type] = bound_++;
        return undefinedOf_[type];
    }

    /// Puts a block between the arms of the selection that `header` heads, if it has two: the merge block of the first
    /// arm, and the header of the second. Values that the first arm sends to the merge block come by way of a phi
    /// there.
    void makeOneArmed(Block &header) {
        if (opcodeOf(header.terminator()) != spv::Op::OpBranchConditional || header.merge() == nullptr ||
            opcodeOf(*header.merge()) != spv::Op::OpSelectionMerge)
            return;
        const Words branch = header.terminator();
        const std::uint32_t merge = (*header.merge())[1];
        if (branch[2] == merge || branch[3] == merge || branch[2] == branch[3])
            return;
        const auto isArm = [&](const Block &block) {
            return block.label() == branch[2] || block.label() == branch[3];
        };
        const auto first = std::ranges::find_if(blocks_, isArm);
        const auto second = std::find_if(std::next(first), blocks_.end(), isArm);
        const std::set<Block *> lastOfFirst = lastOfArm(first->label(), merge);
        for (Block *block : lastOfArm(second->label(), merge))
            if (lastOfFirst.contains(block))
                return; // the arms share a block, and are none

        const std::uint32_t between = bound_++;
        Block &middle = *blocks_.emplace(second);
        blockAt_[between] = &middle;
        middle.instructions.push_back(instructionOf(spv::Op::OpLabel, std::array{between}));
        for (Words &phi : blockAt_.at(merge)->instructions)
            if (opcodeOf(phi) == spv::Op::OpPhi)
                joinFirstArm(phi, lastOfFirst, header.label(), middle);
        middle.instructions.push_back(*header.merge());
        middle.instructions.push_back(branch);
        for (std::uint32_t *target : middle.targets())
            if (*target == first->label())
                *target = merge;

        (*header.merge())[1] = between;
        for (std::uint32_t *target : header.targets())
            if (*target == second->label())
                *target = between;
        for (Block *block : lastOfFirst)
            for (std::uint32_t *target : block->targets())
                if (*target == merge)
                    *target = between;
        for (Words &phi : second->instructions)
            for (std::size_t i = 4; opcodeOf(phi) == spv::Op::OpPhi && i < phi.size(); i += 2)
                if (phi[i] == header.label())
                    phi[i] = between;
    }

    /// Moves the operands of `phi` that come from the first arm to a phi of the block `middle`.
    void joinFirstArm(Words &phi, const std::set<Block *> &lastOfFirst, std::uint32_t header, Block &middle) {
        const std::uint32_t id = bound_++;
        Words joined{phi[1], id, undefinedOf(phi[1]), header};
        Words rest{phi[1], phi[2], id, middle.label()};
        for (std::size_t i = 3; i + 1 < phi.size(); i += 2) {
            Words &to = lastOfFirst.contains(blockAt_.at(phi[i + 1])) ? joined : rest;
            to.insert(to.end(), {phi[i], phi[i + 1]});
        }
        middle.instructions.push_back(instructionOf(spv::Op::OpPhi, joined));
        phi = instructionOf(spv::Op::OpPhi, rest);
    }

    std::uint32_t &bound_;
    std::map<std::uint32_t, std::uint32_t> &undefinedOf_; // OpUndef by type
    std::vector<Words> declaration_;                      // from OpFunction to the first block
    std::list<Block> blocks_;
    std::vector<Words> end_;
    std::map<std::uint32_t, Block *> blockAt_; // by label
};

} // namespace

std::vector<std::uint32_t> makeSelectionsOneArmed(std::span<const std::uint32_t> spirv) {
    Words words(spirv.begin(), spirv.begin() + spirvHeaderWords);
    std::uint32_t bound = spirv[spirvBoundWord];
    std::map<std::uint32_t, std::uint32_t> undefinedOf;
    Words code;
    std::vector<Words> function;
    for (const SpirvInstruction &instruction : instructionsOf(spirv)) {
        if (function.empty() && instruction.opcode() != spv::Op::OpFunction) {
            words.insert(words.end(), instruction.words.begin(), instruction.words.end());
            continue;
        }
        function.emplace_back(instruction.words.begin(), instruction.words.end());
        if (instruction.opcode() == spv::Op::OpFunctionEnd)
            Function(std::exchange(function, {}), bound, undefinedOf).write(code);
    }
    for (const auto &[type, id] : undefinedOf)
        append(words, spv::Op::OpUndef, {type, id});
    words.insert(words.end(), code.begin(), code.end());
    words[spirvBoundWord] = bound;
    return words;
}

} // namespace hyalite::core::gpu
