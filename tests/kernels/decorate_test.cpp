// NoContraction: on every float operation of every kernel, and nothing beside it that rounds as a driver likes.
#include "host/gpu/spirv/decorate.h"

#include "host/gpu/spirv/instructions.h"
#include "host/gpu/spirv/specialise.h"
#include "host/gpu/vk/float_controls.h"
#include "tests/kernels/all_kernels.h"
#include "tests/kernels/assembled_module.h"
#include "tests/kernels/drawn_constants.h"
#include "tests/kernels/spirv_module.h"

#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include <algorithm>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::testing {
namespace {

/// A module whose function `main` does one thing with %x and %y (vec3), %s (float) and %matrix (mat3).
ModuleWords moduleThatDoes(const std::string &operation) {
    const std::string text = R"(
        OpCapability Shader
        %glsl = OpExtInstImport "GLSL.std.450"
        OpMemoryModel Logical GLSL450
        OpEntryPoint GLCompute %main "main"
        OpExecutionMode %main LocalSize 1 1 1
        OpName %main "shade"
        %void = OpTypeVoid
        %float = OpTypeFloat 32
        %vec3 = OpTypeVector %float 3
        %mat3 = OpTypeMatrix %vec3 3
        %function = OpTypeFunction %void
        %s = OpConstant %float 2
        %x = OpConstantComposite %vec3 %s %s %s
        %y = OpConstantComposite %vec3 %s %s %s
        %matrix = OpConstantComposite %mat3 %x %x %x
        %main = OpFunction %void None %function
        %entry = OpLabel
        %result = )" + operation +
                             R"(
        OpReturn
        OpFunctionEnd
    )";
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    ModuleWords words;
    EXPECT_TRUE(tools.Assemble(text, &words)) << operation;
    return words;
}

/// Float operations of a module, and those among them that may be contracted.
struct Roundings {
    std::size_t count = 0;
    std::vector<std::string> contracted; ///< by function
};

Roundings roundingsOf(std::span<const std::uint32_t> words) {
    const SpirvModule module(words);
    Roundings roundings;
    for (const Instruction &instruction : module.instructions) {
        const auto opcode = static_cast<std::uint32_t>(instruction.opcode);
        if (!gpu::isRoundedOperation(opcode))
            continue;
        ++roundings.count;
        if (!module.uncontracted.contains(instruction.operands[1]))
            roundings.contracted.push_back(instruction.function);
    }
    return roundings;
}

TEST(NoContraction, IsOnEveryOperationThatADriverGets) {
    std::mt19937 random(1);
    for (const EmbeddedKernel &kernel : allKernels()) {
        for (int i = 0; i < 3; ++i) {
            const ModuleWords words =
                gpu::addFloatControls(gpu::specialise(kernel.words, drawnConstants(random)), {true, true});
            EXPECT_EQ(roundingsOf(words).contracted, std::vector<std::string>{}) << kernel.name;
        }
        EXPECT_EQ(roundingsOf(kernel.words).contracted, std::vector<std::string>{}) << kernel.name;
        if (!(std::set<std::string_view>{"echoKernel", "laneExchange", "compareWords", "denoiserCounts"}
                  .contains(kernel.name))) {
            EXPECT_GT(roundingsOf(kernel.words).count, 0u) << kernel.name;
        }
    }
}

struct OperationCase {
    const char *name;
    const char *operation;
};

void PrintTo(const OperationCase &one, std::ostream *stream) { *stream << one.name; }

class RoundedOperation : public ::testing::TestWithParam<OperationCase> {};

TEST_P(RoundedOperation, IsDecoratedAndNothingElseChanges) {
    const ModuleWords plain = moduleThatDoes(GetParam().operation);
    ASSERT_EQ(roundingsOf(plain).contracted.size(), 1u);
    const ModuleWords words = gpu::decorateNoContraction(plain);
    EXPECT_TRUE(roundingsOf(words).contracted.empty());
    ASSERT_EQ(words.size(), plain.size() + 3); // one OpDecorate
    EXPECT_TRUE(spvtools::SpirvTools(SPV_ENV_VULKAN_1_1).Validate(words));
    EXPECT_TRUE(std::equal(plain.rbegin(), plain.rbegin() + 20, words.rbegin())) << "the code";
    EXPECT_EQ(gpu::decorateNoContraction(words), words) << "what is decorated stays as it is";
}

INSTANTIATE_TEST_SUITE_P(All, RoundedOperation,
                         ::testing::Values(OperationCase{"add", "OpFAdd %vec3 %x %y"},
                                           OperationCase{"subtract", "OpFSub %vec3 %x %y"},
                                           OperationCase{"multiply", "OpFMul %float %s %s"},
                                           OperationCase{"divide", "OpFDiv %float %s %s"},
                                           OperationCase{"negate", "OpFNegate %vec3 %x"},
                                           OperationCase{"scale", "OpVectorTimesScalar %vec3 %x %s"}));

class RefusedOperation : public ::testing::TestWithParam<OperationCase> {};

TEST_P(RefusedOperation, IsNamedWithItsFunction) {
    try {
        static_cast<void>(gpu::decorateNoContraction(moduleThatDoes(GetParam().operation)));
        FAIL() << "it was accepted";
    } catch (const std::invalid_argument &error) {
        const std::string message = error.what();
        EXPECT_TRUE(
            message.starts_with(std::string(GetParam().name) + " in shade has no fixed order or rounding"))
            << message;
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, RefusedOperation,
    ::testing::Values(OperationCase{"OpDot", "OpDot %float %x %y"},
                      OperationCase{"a product with a matrix", "OpMatrixTimesVector %vec3 %matrix %x"},
                      OperationCase{"a product with a matrix", "OpVectorTimesMatrix %vec3 %x %matrix"},
                      OperationCase{"a product with a matrix", "OpMatrixTimesMatrix %mat3 %matrix %matrix"},
                      OperationCase{"a product with a matrix", "OpMatrixTimesScalar %mat3 %matrix %s"},
                      OperationCase{"a product with a matrix", "OpOuterProduct %mat3 %x %y"},
                      OperationCase{"a remainder of floats", "OpFMod %float %s %s"},
                      OperationCase{"a remainder of floats", "OpFRem %float %s %s"},
                      OperationCase{"fma", "OpExtInst %float %glsl Fma %s %s %s"},
                      OperationCase{"mix", "OpExtInst %vec3 %glsl FMix %x %x %x"},
                      OperationCase{"normalize", "OpExtInst %vec3 %glsl Normalize %x"},
                      OperationCase{"length", "OpExtInst %float %glsl Length %x"},
                      OperationCase{"cross", "OpExtInst %vec3 %glsl Cross %x %y"},
                      OperationCase{"reflect", "OpExtInst %vec3 %glsl Reflect %x %y"},
                      OperationCase{"instruction 13 of GLSL.std.450", "OpExtInst %float %glsl Sin %s"}));

} // namespace
} // namespace hyalite::core::testing
