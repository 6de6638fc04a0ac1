// Specialization constants in SPIR-V: valid modules without the code that they rule out. That pictures stay what they
// are is for tests of images to show: all of them run specialised kernels.
#include "host/gpu/spirv/specialise.h"

#include "host/gpu/spirv/instructions.h"
#include "shaders/layout/layout.h"
#include "tests/fixtures/test_extent.h"
#include "tests/kernels/all_kernels.h"
#include "tests/kernels/assembled_module.h"
#include "tests/kernels/drawn_constants.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

// ---- Our kernels

TEST(Specialise, LeavesValidKernels) {
    std::mt19937 random(1);
    for (const EmbeddedKernel &kernel : kernelsInTurn(1)) {
        for (int i = 0; i < repetitions(1, 6); ++i) {
            const ModuleWords constants = drawnConstants(random);
            const ModuleWords words = gpu::specialise(kernel.words, constants);
            ASSERT_EQ(errorsIn(words), "")
                << kernel.name << " with " << fmt::format("{}", fmt::join(constants, " "));
            for (const spv::Op opcode : {spv::Op::OpSpecConstant, spv::Op::OpSpecConstantTrue,
                                         spv::Op::OpSpecConstantFalse, spv::Op::OpSpecConstantOp})
                ASSERT_EQ(countOf(words, opcode), 0u) << kernel.name;
        }
    }
}

TEST(Specialise, LeavesOutWhatASceneDoesNotUse) {
    const std::span<const std::uint32_t> kernel = embeddedKernel("pathSkipOneSlot");
    ModuleWords constants(layout::constantCount);
    constants[layout::constantWorkgroupSize] = 64;
    constants[layout::constantSamplesInFlight] = 8;
    constants[layout::constantExactDivision] = 1;
    const ModuleWords least = gpu::specialise(kernel, constants);
    EXPECT_LT(least.size() * 10, kernel.size());
    const std::size_t reads = countOf(least, spv::Op::OpImageRead);
    constants[layout::constantHasTriangles] = 1;
    const ModuleWords triangles = gpu::specialise(kernel, constants);
    EXPECT_GT(countOf(triangles, spv::Op::OpImageRead), reads);
    constants[layout::constantTexturing] = layout::texturesBaseColour;
    const ModuleWords textures = gpu::specialise(kernel, constants);
    EXPECT_GT(countOf(textures, spv::Op::OpImageRead), countOf(triangles, spv::Op::OpImageRead));
    // Our own division and root are integer arithmetic on significands.
    const std::size_t native = countOf(textures, spv::Op::OpFDiv);
    constants[layout::constantExactDivision] = 0;
    const ModuleWords ours = gpu::specialise(kernel, constants);
    EXPECT_LT(countOf(ours, spv::Op::OpFDiv), native);
    EXPECT_GT(countOf(ours, spv::Op::OpIMul), countOf(textures, spv::Op::OpIMul));
}

// ---- Written by hand

/// The module for these constants, which must be valid.
ModuleWords specialised(const ModuleWords &words, const ModuleWords &constants = {}) {
    ModuleWords result = gpu::specialise(words, constants);
    EXPECT_EQ(errorsIn(result), "") << "after";
    return result;
}

const std::string eitherOne = R"(
    OpSelectionMerge %end None
    OpBranchConditional %yes %then %else
    %then = OpLabel
    OpStore %word %c1
    OpBranch %end
    %else = OpLabel
    OpStore %word %c2
    OpBranch %end
    %end = OpLabel
    %which = OpPhi %uint %c3 %then %c4 %else
    OpStore %word %which
    OpReturn
)";

TEST(Specialise, TakesGivenValuesAndElseDefaults) {
    const ModuleWords words = moduleWith(eitherOne);
    EXPECT_EQ(storesOf(words), "1 2 ? ");
    EXPECT_EQ(storesOf(specialised(words)), "1 3 ") << "true by default";
    EXPECT_EQ(storesOf(specialised(words, {0})), "2 4 ");
    EXPECT_EQ(storesOf(specialised(words, {7})), "1 3 ") << "any word but 0 is true";
    EXPECT_EQ(countOf(specialised(words), spv::Op::OpBranchConditional), 0u);
    EXPECT_EQ(countOf(specialised(words), spv::Op::OpSelectionMerge), 0u);
}

TEST(Specialise, KeepsWhatItCannotKnow) {
    const std::string body = R"(
        OpSelectionMerge %end None
        OpBranchConditional %unknown %then %end
        %then = OpLabel
        OpStore %word %c1
        OpBranch %end
        %end = OpLabel
        OpReturn
    )";
    const ModuleWords words = specialised(moduleWith(body));
    EXPECT_EQ(storesOf(words), "1 ");
    EXPECT_EQ(countOf(words, spv::Op::OpBranchConditional), 1u);
}

TEST(Specialise, EvaluatesOperationsOnConstants) {
    const std::string declarations = R"(
        %sum = OpSpecConstantOp %uint IAdd %seven %c2
        %difference = OpSpecConstantOp %uint ISub %c1 %seven
        %product = OpSpecConstantOp %uint IMul %seven %c3
        %both = OpSpecConstantOp %uint BitwiseAnd %seven %c4
        %any = OpSpecConstantOp %uint BitwiseOr %seven %c8
        %half = OpSpecConstantOp %uint ShiftRightLogical %seven %c1
        %complement = OpSpecConstantOp %uint Not %seven
        %equal = OpSpecConstantOp %bool IEqual %sum %c9
        %less = OpSpecConstantOp %bool ULessThan %difference %c1
        %most = OpSpecConstantOp %bool ULessThanEqual %seven %c7
        %more = OpSpecConstantOp %bool UGreaterThan %difference %c1
        %least = OpSpecConstantOp %bool UGreaterThanEqual %seven %c8
        %and = OpSpecConstantOp %bool LogicalAnd %equal %less
        %or = OpSpecConstantOp %bool LogicalOr %least %more
        %not = OpSpecConstantOp %bool LogicalNot %or
        %same = OpSpecConstantOp %bool LogicalEqual %most %or
        %other = OpSpecConstantOp %bool LogicalNotEqual %and %not
        %unequal = OpSpecConstantOp %bool INotEqual %seven %c7
        %a = OpSpecConstantOp %uint Select %and %c1 %c2
        %b = OpSpecConstantOp %uint Select %same %c3 %c4
        %c = OpSpecConstantOp %uint Select %other %c5 %c6
        %d = OpSpecConstantOp %uint Select %unequal %c7 %c8
        %shifted = OpSpecConstantOp %uint ShiftLeftLogical %seven %c1
    )";
    std::string body;
    for (const char *name :
         {"sum", "difference", "product", "both", "any", "half", "complement", "a", "b", "c", "d", "shifted"})
        body += fmt::format("OpStore %word %{}\n", name);
    const std::string composites = R"(
        %pair = OpTypeVector %uint 2
        %known = OpSpecConstantComposite %pair %seven %c1
        %shiftedToo = OpSpecConstantComposite %pair %seven %shifted
    )";
    const ModuleWords words = specialised(moduleWith(body + "OpReturn", declarations + composites));
    EXPECT_EQ(storesOf(words), "9 4294967290 21 4 15 3 4294967288 2 3 6 8 ? ");
    EXPECT_EQ(countOf(words, spv::Op::OpSpecConstantOp), 1u) << "what it does not know is left to the driver";
    EXPECT_EQ(countOf(words, spv::Op::OpSpecConstantComposite), 1u) << "and what is made of that";
    EXPECT_EQ(countOf(words, spv::Op::OpConstantComposite), 1u);
    EXPECT_EQ(storesOf(specialised(moduleWith("OpStore %word %seven\nOpReturn"), {1, 1, 5})), "5 ");
}

TEST(Specialise, KnowsWhatFollowsFromConstants) {
    // `no && unknown`, as compilers write it, and a selection by it.
    const std::string body = R"(
        OpSelectionMerge %joined None
        OpBranchConditional %no %right %joined
        %right = OpLabel
        OpBranch %joined
        %joined = OpLabel
        %both = OpPhi %bool %no %entry %unknown %right
        %neither = OpLogicalNot %bool %both
        %all = OpLogicalAnd %bool %neither %unknown
        OpSelectionMerge %end None
        OpBranchConditional %both %then %end
        %then = OpLabel
        OpStore %word %c1
        OpBranch %end
        %end = OpLabel
        OpSelectionMerge %last None
        OpBranchConditional %all %more %last
        %more = OpLabel
        OpStore %word %c2
        OpBranch %last
        %last = OpLabel
        OpReturn
    )";
    const ModuleWords words = moduleWith(body);
    EXPECT_EQ(storesOf(specialised(words)), "2 ");
    EXPECT_EQ(storesOf(specialised(words, {1, 1})), "1 2 ");
}

TEST(Specialise, KnowsNothingOfLoops) {
    // i is 0 where the loop begins, but not on its way back.
    const std::string body = R"(
        OpBranch %header
        %header = OpLabel
        %i = OpPhi %uint %c0 %entry %next %continue
        %isFirst = OpIEqual %bool %i %c0
        OpLoopMerge %end %continue None
        OpBranch %body
        %body = OpLabel
        OpSelectionMerge %after None
        OpBranchConditional %isFirst %first %later
        %first = OpLabel
        OpStore %word %c1
        OpBranch %after
        %later = OpLabel
        OpStore %word %c2
        OpBranch %after
        %after = OpLabel
        OpBranch %continue
        %continue = OpLabel
        %next = OpIAdd %uint %i %c1
        %goesOn = OpULessThan %bool %next %c5
        OpBranchConditional %goesOn %header %end
        %end = OpLabel
        OpReturn
    )";
    EXPECT_EQ(storesOf(specialised(moduleWith(body))), "1 2 ");
}

TEST(Specialise, KeepsALoopWhoseWayBackIsGone) {
    const std::string body = R"(
        OpBranch %header
        %header = OpLabel
        %i = OpPhi %uint %c0 %entry %next %continue
        OpLoopMerge %end %continue None
        OpBranch %body
        %body = OpLabel
        OpStore %word %i
        OpSelectionMerge %after None
        OpBranchConditional %yes %leave %after
        %leave = OpLabel
        OpBranch %end
        %after = OpLabel
        %next = OpIAdd %uint %i %c1
        OpStore %word %c2
        OpBranch %continue
        %continue = OpLabel
        OpBranch %header
        %end = OpLabel
        OpStore %word %c3
        OpReturn
    )";
    const ModuleWords words = moduleWith(body);
    EXPECT_EQ(storesOf(specialised(words)), "? 3 ");
    EXPECT_EQ(countOf(specialised(words), spv::Op::OpLoopMerge), 1u);
    EXPECT_EQ(storesOf(specialised(words, {0})), "? 2 ") << "and one that nothing leaves";
}

TEST(Specialise, KeepsASelectionThatIsLeftOnACondition) {
    const std::string body = R"(
        OpSelectionMerge %end None
        OpBranchConditional %yes %then %else
        %then = OpLabel
        OpStore %word %c1
        OpBranchConditional %unknown %more %end
        %more = OpLabel
        OpStore %word %c2
        OpBranch %end
        %else = OpLabel
        OpStore %word %c3
        OpBranch %end
        %end = OpLabel
        OpReturn
    )";
    EXPECT_EQ(storesOf(specialised(moduleWith(body))), "1 2 3 ");
    EXPECT_EQ(storesOf(specialised(moduleWith(body), {0})), "3 ");
}

TEST(Specialise, KeepsTheWaysBackOfLoops) {
    // `do ... while (f())`, where f returns early, whatever `unknown` is.
    const std::string body = R"(
        OpBranch %header
        %header = OpLabel
        OpLoopMerge %end %continue None
        OpBranch %body
        %body = OpLabel
        OpStore %word %c1
        OpBranch %continue
        %continue = OpLabel
        OpSelectionMerge %returned None
        OpSwitch %c0 %inlined
        %inlined = OpLabel
        OpSelectionMerge %after None
        OpBranchConditional %unknown %early %else
        %early = OpLabel
        OpBranch %returned
        %else = OpLabel
        OpSelectionMerge %inner None
        OpBranchConditional %yes %leave %inner
        %leave = OpLabel
        OpBranch %returned
        %inner = OpLabel
        OpStore %word %c2
        OpBranch %after
        %after = OpLabel
        OpBranch %returned
        %returned = OpLabel
        %goesOn = OpPhi %bool %unknown %early %no %leave %yes %after
        OpBranchConditional %goesOn %header %end
        %end = OpLabel
        OpReturn
    )";
    EXPECT_EQ(storesOf(specialised(moduleWith(body))), "1 2 ");
    EXPECT_EQ(storesOf(specialised(moduleWith(body), {0})), "1 2 ");
}

TEST(Specialise, KeepsWhereASelectionEndsThatIsNeverLeft) {
    const std::string body = R"(
        OpSelectionMerge %end None
        OpBranchConditional %unknown %then %else
        %then = OpLabel
        OpStore %word %c1
        OpReturn
        %else = OpLabel
        OpSelectionMerge %inner None
        OpBranchConditional %yes %leave %inner
        %leave = OpLabel
        OpReturn
        %inner = OpLabel
        OpStore %word %c2
        OpBranch %end
        %end = OpLabel
        OpStore %word %c3
        OpReturn
    )";
    const ModuleWords words = specialised(moduleWith(body));
    EXPECT_EQ(storesOf(words), "1 ");
    EXPECT_EQ(countOf(words, spv::Op::OpUnreachable), 1u);
}

/// What inlining makes of `if (CONDITION) { store 1; return; } store 2;`, and then 3.
std::string inlinedWithReturn(const std::string &condition) {
    return R"(
        OpSelectionMerge %end None
        OpSwitch %c0 %body
        %body = OpLabel
        OpSelectionMerge %after None
        OpBranchConditional )" +
           condition + R"( %early %after
        %early = OpLabel
        OpStore %word %c1
        OpBranch %end
        %after = OpLabel
        OpStore %word %c2
        OpBranch %end
        %end = OpLabel
        OpStore %word %c3
        OpReturn
    )";
}

TEST(Specialise, UnwrapsFunctionsThatNoLongerReturnEarly) {
    for (const char *condition : {"%yes", "%no"}) {
        const ModuleWords words = specialised(moduleWith(inlinedWithReturn(condition)));
        EXPECT_EQ(countOf(words, spv::Op::OpSwitch), 0u) << condition;
        EXPECT_EQ(storesOf(words), condition == std::string("%yes") ? "1 3 " : "2 3 ");
    }
    const ModuleWords words = specialised(moduleWith(inlinedWithReturn("%unknown")));
    EXPECT_EQ(countOf(words, spv::Op::OpSwitch), 1u);
    EXPECT_EQ(storesOf(words), "1 2 3 ");
}

TEST(Specialise, KeepsASwitchThatIsLeftFromWithin) {
    // One way out is left, but from inside of a selection.
    const std::string body = R"(
        OpSelectionMerge %end None
        OpSwitch %c0 %body
        %body = OpLabel
        OpSelectionMerge %after None
        OpBranchConditional %unknown %early %other
        %early = OpLabel
        OpStore %word %c1
        OpBranch %end
        %other = OpLabel
        OpReturn
        %after = OpLabel
        OpBranch %end
        %end = OpLabel
        OpStore %word %c3
        OpReturn
    )";
    const ModuleWords words = specialised(moduleWith(body));
    EXPECT_EQ(countOf(words, spv::Op::OpSwitch), 1u);
    EXPECT_EQ(storesOf(words), "1 3 ");
}

TEST(Specialise, DropsNamesAndDecorationsOfWhatIsGone) {
    for (const EmbeddedKernel &kernel : allKernels()) {
        const ModuleWords words = gpu::specialise(kernel.words, ModuleWords(layout::constantCount));
        std::vector<bool> isDefined(words[gpu::spirvBoundWord]);
        const auto instructions = gpu::instructionsOf(words);
        for (const gpu::SpirvInstruction &instruction : instructions)
            isDefined[instruction.result()] = true;
        for (const gpu::SpirvInstruction &instruction : instructions) {
            if (instruction.opcode() == spv::Op::OpName || instruction.opcode() == spv::Op::OpDecorate) {
                ASSERT_TRUE(isDefined[instruction.words[1]]) << kernel.name;
            }
        }
    }
}

} // namespace
} // namespace hyalite::core::testing
