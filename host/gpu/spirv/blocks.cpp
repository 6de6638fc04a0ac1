#include "host/gpu/spirv/blocks.h"

#include <algorithm>

namespace hyalite::core::gpu {

SpirvBlocks::SpirvBlocks(std::span<const SpirvInstruction> instructions, const std::vector<SpirvValue> &known)
    : instructions_(instructions), constants_(known), indexOf_(known.size()), isNeeded_(known.size()) {
    findBlocks();
    findContinueConstructs();
    do
        while (propagate()) {
        }
    while (pinSelectionsLeftOnConditions());
    unwrapSwitches();
    findNeededBlocks();
}

void SpirvBlocks::findBlocks() {
    bool isBeforeEntry = true; // of a function
    for (std::size_t i = 0; i < instructions_.size(); ++i) {
        const std::span<const std::uint32_t> words = instructions_[i].words;
        switch (instructions_[i].opcode()) {
        case spv::Op::OpLabel:
            indexOf_[words[1]] = blocks_.size();
            blocks_.push_back({.begin = i, .label = words[1], .isReached = isBeforeEntry});
            isBeforeEntry = false;
            break;
        case spv::Op::OpLoopMerge:
            blocks_.back().continueTarget = words[2];
            [[fallthrough]];
        case spv::Op::OpSelectionMerge:
            blocks_.back().merge = words[1];
            break;
        case spv::Op::OpFunctionEnd:
            isBeforeEntry = true;
            break;
        default:
            if (!isBeforeEntry)
                blocks_.back().end = i + 1;
            break;
        }
    }
}

// Finds the continue constructs: the blocks from a continue target back to the header of its loop. The back edge must
// stay reachable from the continue target, so all of these blocks are pinned.
void SpirvBlocks::findContinueConstructs() {
    for (const SpirvBlock &header : blocks_) { // outer loops come first
        if (header.continueTarget == 0)
            continue;
        std::vector<std::uint32_t> labels{header.continueTarget};
        while (!labels.empty()) {
            SpirvBlock &block = blockAt(labels.back());
            labels.pop_back();
            if (block.label == header.label || block.label == header.merge ||
                block.continuedLoop == header.label)
                continue;
            block.continuedLoop = header.label;
            block.isPinned = true;
            for (const std::uint32_t label : successors(block))
                labels.push_back(label);
        }
    }
}

std::vector<std::uint32_t> SpirvBlocks::successors(const SpirvBlock &block) const {
    if (block.only != 0)
        return {block.only};
    const SpirvInstruction &last = terminatorOf(block);
    switch (last.opcode()) {
    case spv::Op::OpBranch:
        return {last.words[1]};
    case spv::Op::OpBranchConditional:
        return {last.words[2], last.words[3]};
    case spv::Op::OpSwitch: {
        std::vector<std::uint32_t> targets{last.words[2]};
        for (std::size_t i = 4; i < last.words.size(); i += 2)
            targets.push_back(last.words[i]);
        return targets;
    }
    default:
        return {};
    }
}

bool SpirvBlocks::isEdge(std::uint32_t from, std::uint32_t to) const {
    const SpirvBlock &block = at(from);
    return block.isReached && (block.only == 0 || block.only == to);
}

// The common value of a phi over its remaining incoming edges; empty if they differ or one is unknown.
SpirvValue SpirvBlocks::valueOfPhi(const SpirvBlock &block, std::span<const std::uint32_t> phi,
                                   const std::vector<SpirvValue> &known) const {
    SpirvValue value;
    bool isFirst = true;
    for (std::size_t i = 3; i + 1 < phi.size(); i += 2) {
        if (!isEdge(phi[i + 1], block.label))
            continue;
        if (!known[phi[i]] || (!isFirst && known[phi[i]] != value))
            return {};
        value = known[phi[i]];
        isFirst = false;
    }
    return value;
}

// One pass over all blocks known to be reachable. Returns whether it reached anything new. Known values may then be out
// of date, because a phi has another incoming edge.
bool SpirvBlocks::propagate() {
    bool hasChanged = false;
    std::vector<SpirvValue> known = constants_;
    for (SpirvBlock &block : blocks_) {
        if (!block.isReached)
            continue;
        const bool isLoopHeader = block.continueTarget != 0;
        for (std::size_t i = block.begin + 1; i + 1 < block.end; ++i) {
            const std::span<const std::uint32_t> words = instructions_[i].words;
            const spv::Op opcode = instructions_[i].opcode();
            if (opcode == spv::Op::OpPhi && !isLoopHeader)
                known[words[2]] = valueOfPhi(block, words, known);
            else if (const SpirvValue value = evaluate(opcode, operandsOf(words, 3, known)))
                known[words[2]] = value;
        }
        const SpirvInstruction &last = terminatorOf(block);
        const bool isSelection = last.opcode() == spv::Op::OpBranchConditional && block.merge != 0 &&
                                 !isLoopHeader && !block.isPinned;
        const SpirvValue condition = isSelection ? known[last.words[1]] : SpirvValue();
        const std::uint32_t only = condition ? last.words[*condition != 0 ? 2 : 3] : 0;
        hasChanged = hasChanged || only != block.only;
        block.only = only;
        for (const std::uint32_t label : successors(block)) {
            SpirvBlock &next = blockAt(label);
            hasChanged = hasChanged || !next.isReached;
            next.isReached = true;
        }
    }
    return hasChanged;
}

// A conditional branch may exit a selection to its merge block only while the selection exists. Pins the selections
// that such branches exit. Returns whether a resolved selection became unresolved.
bool SpirvBlocks::pinSelectionsLeftOnConditions() {
    std::vector<SpirvBlock *> headerOf(indexOf_.size()); // headers of resolved selections, by merge block
    for (SpirvBlock &block : blocks_)
        if (block.isReached && block.only != 0)
            headerOf[block.merge] = &block;
    bool hasChanged = false;
    for (const SpirvBlock &block : blocks_) {
        if (!block.isReached || block.only != 0 ||
            terminatorOf(block).opcode() != spv::Op::OpBranchConditional)
            continue;
        for (const std::uint32_t label : successors(block))
            if (SpirvBlock *header = headerOf[label]; header != nullptr && block.merge != label)
                header->isPinned = hasChanged = true;
    }
    return hasChanged;
}

// Inlining wraps functions with early returns in a switch with a single target, so that a return is an exit from the
// switch. Without early returns the switch is redundant, and drivers take long to lower it.
void SpirvBlocks::unwrapSwitches() {
    std::vector<std::uint32_t> edgeCount(indexOf_.size()); // to each block
    for (const SpirvBlock &block : blocks_)
        if (block.isReached)
            for (const std::uint32_t label : successors(block))
                ++edgeCount[label];
    for (SpirvBlock &block : blocks_) {
        const std::span<const std::uint32_t> last = terminatorOf(block).words;
        const bool isWrapper = terminatorOf(block).opcode() == spv::Op::OpSwitch && last.size() == 3;
        if (!block.isReached || !isWrapper || edgeCount[block.merge] != 1)
            continue;
        // The remaining path must go through whole constructs only and must not exit one.
        std::uint32_t label = last[2];
        while (label != block.merge && label != 0) {
            const SpirvBlock &next = at(label);
            const std::vector<std::uint32_t> targets =
                next.isReached ? successors(next) : std::vector<std::uint32_t>();
            const bool isConstruct = next.isReached && next.merge != 0 && next.only == 0;
            label = isConstruct ? next.merge : (targets.size() == 1 ? targets[0] : 0);
        }
        if (label == block.merge)
            block.only = last[2];
    }
}

void SpirvBlocks::findNeededBlocks() {
    for (const SpirvBlock &block : blocks_) {
        if (!block.isReached)
            continue;
        isNeeded_[block.label] = true;
        if (block.merge != 0 && block.only == 0)
            isNeeded_[block.merge] = true;
        if (block.continueTarget != 0)
            isNeeded_[block.continueTarget] = true;
    }
}

} // namespace hyalite::core::gpu
