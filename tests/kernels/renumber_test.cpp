// Ids without gaps: the same module, by the judgement of SPIRV-Tools, with as few ids as it needs.
#include "host/gpu/spirv/renumber.h"

#include "host/gpu/spirv/specialise.h"
#include "tests/fixtures/test_extent.h"
#include "tests/kernels/all_kernels.h"
#include "tests/kernels/assembled_module.h"
#include "tests/kernels/drawn_constants.h"

#include <gtest/gtest.h>
#include <spirv-tools/optimizer.hpp>

#include <random>
#include <stdexcept>

namespace hyalite::core::testing {
namespace {

/// The module with the ids that SPIRV-Tools gives it, in the order of their first mention.
ModuleWords compacted(const ModuleWords &words) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    optimizer.RegisterPass(spvtools::CreateCompactIdsPass());
    ModuleWords result;
    EXPECT_TRUE(optimizer.Run(words.data(), words.size(), &result));
    return result;
}

TEST(Renumber, IsWhatSpirvToolsMake) {
    std::mt19937 random(1);
    for (const EmbeddedKernel &kernel : kernelsInTurn(0)) {
        for (int i = 0; i < repetitions(1, 4); ++i) {
            const ModuleWords specialised = gpu::specialise(kernel.words, drawnConstants(random));
            const ModuleWords words = gpu::renumber(specialised);
            ASSERT_EQ(errorsIn(words), "") << kernel.name;
            ASSERT_EQ(words, compacted(specialised)) << kernel.name;
            ASSERT_LE(words[gpu::spirvBoundWord], specialised[gpu::spirvBoundWord]) << kernel.name;
        }
    }
}

TEST(Renumber, KnowsLiteralsFromIds) {
    const ModuleWords words = gpu::renumber(moduleWith(R"(
        OpSelectionMerge %end None
        OpSwitch %c3 %end 7 %other 65000 %end
        %other = OpLabel
        OpStore %word %c1
        OpBranch %end
        %end = OpLabel
        OpReturn
    )"));
    EXPECT_EQ(errorsIn(words), "");
    EXPECT_EQ(storesOf(words), "1 ");
    EXPECT_EQ(gpu::renumber(words), words);
    for (const gpu::SpirvInstruction &instruction : gpu::instructionsOf(words))
        if (instruction.opcode() == spv::Op::OpSwitch) {
            EXPECT_EQ(instruction.words[3], 7u);
            EXPECT_EQ(instruction.words[5], 65000u);
        }
}

TEST(Renumber, RefusesWhatItDoesNotKnow) {
    ModuleWords words = moduleWith("OpReturn");
    gpu::append(words, spv::Op::OpEmitVertex, {});
    EXPECT_THROW((void)gpu::renumber(words), std::invalid_argument);
    words = moduleWith("OpReturn");
    gpu::append(words, spv::Op::OpBranch, {words[gpu::spirvBoundWord]});
    EXPECT_THROW((void)gpu::renumber(words), std::invalid_argument) << "an id beyond the bound";
}

} // namespace
} // namespace hyalite::core::testing
