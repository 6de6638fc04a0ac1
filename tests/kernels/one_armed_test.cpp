// Selections with one arm instead of two: valid modules that do the same. That pictures stay what they are is for tests
// of images to show.
#include "host/gpu/spirv/one_armed.h"

#include "host/gpu/spirv/specialise.h"
#include "tests/fixtures/test_extent.h"
#include "tests/kernels/all_kernels.h"
#include "tests/kernels/assembled_module.h"
#include "tests/kernels/drawn_constants.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

/// Selections whose branch goes to two blocks other than the merge block.
int twoArmedCount(const ModuleWords &words) {
    int count = 0;
    std::uint32_t merge = 0;
    for (const gpu::SpirvInstruction &instruction : gpu::instructionsOf(words)) {
        const auto &operands = instruction.words;
        if (instruction.opcode() == spv::Op::OpBranchConditional && merge != 0)
            count += operands[2] != merge && operands[3] != merge ? 1 : 0;
        merge = instruction.opcode() == spv::Op::OpSelectionMerge ? operands[1] : 0;
    }
    return count;
}

TEST(OneArmed, LeavesNoSelectionOfTwoArmsInAKernel) {
    std::mt19937 random(1);
    int before = 0;
    for (const EmbeddedKernel &kernel : kernelsInTurn(2)) {
        for (int i = 0; i < repetitions(1, 4); ++i) {
            const ModuleWords specialised = gpu::specialise(kernel.words, drawnConstants(random));
            const ModuleWords words = gpu::makeSelectionsOneArmed(specialised);
            ASSERT_EQ(errorsIn(words), "") << kernel.name;
            ASSERT_EQ(twoArmedCount(words), 0) << kernel.name;
            before += twoArmedCount(specialised);
        }
    }
    EXPECT_GT(before, repetitions(300, 1000)) << "nothing was tested";
}

TEST(OneArmed, SendsValuesOfTheFirstArmThroughAPhi) {
    const ModuleWords words = gpu::makeSelectionsOneArmed(moduleWith(R"(
        OpSelectionMerge %end None
        OpBranchConditional %unknown %then %else
        %then = OpLabel
        OpBranch %end
        %else = OpLabel
        OpBranch %end
        %end = OpLabel
        %which = OpPhi %uint %c3 %then %c4 %else
        OpStore %word %which
        OpReturn
    )"));
    EXPECT_EQ(errorsIn(words), "");
    EXPECT_EQ(twoArmedCount(words), 0);
    EXPECT_EQ(countOf(words, spv::Op::OpBranchConditional), 2u);
    EXPECT_EQ(countOf(words, spv::Op::OpPhi), 2u);
    EXPECT_EQ(countOf(words, spv::Op::OpUndef), 1u);
}

TEST(OneArmed, LeavesASelectionOfOneArmAsItIs) {
    const ModuleWords words = moduleWith(R"(
        OpSelectionMerge %end None
        OpBranchConditional %unknown %end %else
        %else = OpLabel
        OpStore %word %c1
        OpBranch %end
        %end = OpLabel
        OpReturn
    )");
    EXPECT_EQ(gpu::makeSelectionsOneArmed(words), words);
}

/// Draws the body of a function: nested selections by the conditions %is0 to %is7, some in a switch that is left from
/// within, as inlined functions with early returns are.
class DrawnBody {
  public:
    explicit DrawnBody(std::uint32_t seed) : random_(seed) {
        if (drawBlocks(4))
            text_ += "OpReturn\n";
    }

    [[nodiscard]] const std::string &text() const { return text_; }

  private:
    struct Exits {
        std::string label;
        int count = 0;
    };

    int below(int bound) { return static_cast<int>(random_() % static_cast<std::uint32_t>(bound)); }
    std::string newLabel() { return fmt::format("%label{}", nextLabel_++); }
    void begin(const std::string &label) {
        text_ += label + " = OpLabel\n";
        current_ = label;
    }

    /// Whether control comes to the end of what is drawn.
    bool drawBlocks(int depth) {
        for (int i = below(3) + 1; i > 0; --i) {
            text_ += fmt::format("OpStore %word %c{}\n", below(10));
            if (depth > 0 && !(below(3) == 0 ? drawSwitch(depth) : drawSelection(depth)))
                return false;
        }
        return true;
    }

    bool drawSelection(int depth) {
        const std::string first = newLabel(), second = newLabel(), merge = newLabel();
        const bool isFirstIfTrue = below(2) == 0;
        text_ += fmt::format("OpSelectionMerge {} None\nOpBranchConditional %is{} {} {}\n", merge, below(8),
                             isFirstIfTrue ? first : second, isFirstIfTrue ? second : first);
        std::string incoming;
        for (const std::string &arm : {first, second}) {
            begin(arm);
            if (!drawBlocks(depth - 1))
                continue;
            if (!switches_.empty() && below(4) == 0) {
                ++switches_.back().count;
                text_ += fmt::format("OpBranch {}\n", switches_.back().label);
                continue;
            }
            incoming += fmt::format(" %c{} {}", below(10), current_);
            text_ += fmt::format("OpBranch {}\n", merge);
        }
        begin(merge);
        if (incoming.empty()) {
            text_ += "OpUnreachable\n";
            return false;
        }
        const int id = nextLabel_++;
        text_ += fmt::format("%value{} = OpPhi %uint{}\nOpStore %word %value{}\n", id, incoming, id);
        return true;
    }

    bool drawSwitch(int depth) {
        const std::string body = newLabel(), merge = newLabel();
        text_ += fmt::format("OpSelectionMerge {} None\nOpSwitch %c0 {}\n", merge, body);
        switches_.push_back({merge});
        begin(body);
        if (drawBlocks(depth - 1)) {
            ++switches_.back().count;
            text_ += fmt::format("OpBranch {}\n", merge);
        }
        const int exits = switches_.back().count;
        switches_.pop_back();
        begin(merge);
        if (exits == 0)
            text_ += "OpUnreachable\n";
        return exits != 0;
    }

    std::mt19937 random_;
    std::string text_;
    std::string current_;
    int nextLabel_ = 0;
    std::vector<Exits> switches_;
};

TEST(OneArmed, DoesTheSameInEachCase) {
    std::string declarations;
    for (int bit = 0; bit < 8; ++bit)
        declarations += fmt::format("%mask{0} = OpConstant %uint {1}\n"
                                    "%bit{0} = OpSpecConstantOp %uint BitwiseAnd %seven %mask{0}\n"
                                    "%is{0} = OpSpecConstantOp %bool INotEqual %bit{0} %c0\n",
                                    bit, 1 << bit);
    std::mt19937 random(1);
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const ModuleWords words = moduleWith(DrawnBody(seed).text(), declarations);
        const ModuleWords oneArmed = gpu::makeSelectionsOneArmed(words);
        ASSERT_EQ(errorsIn(oneArmed), "") << "seed " << seed;
        ASSERT_EQ(twoArmedCount(oneArmed), 0) << "seed " << seed;
        for (int i = 0; i < 10; ++i) {
            const ModuleWords constants{1, 0, static_cast<std::uint32_t>(random() & 255u)};
            ASSERT_EQ(storesOf(gpu::specialise(oneArmed, constants)),
                      storesOf(gpu::specialise(words, constants)))
                << "seed " << seed << ", bits " << constants[2];
        }
    }
}

} // namespace
} // namespace hyalite::core::testing
