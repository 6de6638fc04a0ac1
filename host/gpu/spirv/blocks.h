// The basic blocks of a SPIR-V module, and which of them are reachable once its constants are known.
//
// Wegman and Zadeck, "Constant Propagation with Conditional Branches", TOPLAS 13(2), 1991, but without loops: a loop
// header assumes no constants. Only two-way selections (OpSelectionMerge and OpBranchConditional) outside of continue
// constructs are resolved. Loops keep their back edges and exits, so control flow stays structured (SPIR-V, section
// 2.11).
#pragma once

#include "host/gpu/spirv/constants.h"

namespace hyalite::core::gpu {

/// A label, instructions, and a terminator, which a merge instruction may precede.
struct SpirvBlock {
    std::size_t begin = 0; ///< its label, among the instructions
    std::size_t end = 0;   ///< past its terminator
    std::uint32_t label = 0;
    std::uint32_t merge = 0;          ///< merge block of the construct that this block heads, or 0
    std::uint32_t continueTarget = 0; ///< of the loop that this block heads, or 0
    /// Header of the innermost loop whose continue construct contains this block, or 0.
    std::uint32_t continuedLoop = 0;
    bool isReached = false;
    std::uint32_t only = 0; ///< the only successor of a selection that can be taken, if known; or 0
    bool isPinned = false;  ///< all successors stay reachable, whatever is known
};

class SpirvBlocks {
  public:
    /// `known` are the constants, by id. Both arguments must outlive this object.
    SpirvBlocks(std::span<const SpirvInstruction> instructions, const std::vector<SpirvValue> &known);

    [[nodiscard]] const SpirvBlock &at(std::uint32_t label) const { return blocks_[indexOf_[label]]; }

    /// Whether control can go from the end of `from` to `to`, one of its successors in the module.
    [[nodiscard]] bool isEdge(std::uint32_t from, std::uint32_t to) const;

    /// Whether the specialised module needs the block: it is reachable, or the target of a merge instruction.
    [[nodiscard]] bool isNeeded(std::uint32_t label) const { return isNeeded_[label]; }

  private:
    SpirvBlock &blockAt(std::uint32_t label) { return blocks_[indexOf_[label]]; }
    [[nodiscard]] const SpirvInstruction &terminatorOf(const SpirvBlock &block) const {
        return instructions_[block.end - 1];
    }
    [[nodiscard]] std::vector<std::uint32_t> successors(const SpirvBlock &block) const;
    [[nodiscard]] SpirvValue valueOfPhi(const SpirvBlock &block, std::span<const std::uint32_t> phi,
                                        const std::vector<SpirvValue> &known) const;
    void findBlocks();
    void findContinueConstructs();
    bool propagate();
    bool pinSelectionsLeftOnConditions();
    void unwrapSwitches();
    void findNeededBlocks();

    std::span<const SpirvInstruction> instructions_;
    const std::vector<SpirvValue> &constants_;
    std::vector<SpirvBlock> blocks_;
    std::vector<std::size_t> indexOf_; // by label
    std::vector<bool> isNeeded_;       // likewise
};

} // namespace hyalite::core::gpu
