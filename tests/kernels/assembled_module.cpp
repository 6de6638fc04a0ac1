#include "tests/kernels/assembled_module.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include <algorithm>
#include <map>

namespace hyalite::core::testing {

namespace {

/// An assembler and validator for Vulkan 1.1 that keeps what it says.
struct Tools {
    std::string messages;
    spvtools::SpirvTools tools{SPV_ENV_VULKAN_1_1};

    Tools() {
        tools.SetMessageConsumer(
            [this](spv_message_level_t, const char *, const spv_position_t &at, const char *message) {
                messages += fmt::format("line {}: {}\n", at.line, message);
            });
    }
};

} // namespace

std::string errorsIn(const ModuleWords &words) {
    Tools validator;
    return validator.tools.Validate(words) ? "" : validator.messages + "invalid";
}

std::size_t countOf(const ModuleWords &words, spv::Op opcode) {
    const auto instructions = gpu::instructionsOf(words);
    return static_cast<std::size_t>(
        std::ranges::count(instructions, opcode, [](const auto &i) { return i.opcode(); }));
}

ModuleWords moduleWith(const std::string &body, const std::string &declarations) {
    std::string text = R"(
        OpCapability Shader
        OpMemoryModel Logical GLSL450
        OpEntryPoint GLCompute %main "main"
        OpExecutionMode %main LocalSize 1 1 1
        OpDecorate %yes SpecId 0
        OpDecorate %no SpecId 1
        OpDecorate %seven SpecId 2
        OpDecorate %Block Block
        OpMemberDecorate %Block 0 Offset 0
        OpDecorate %buffer DescriptorSet 0
        OpDecorate %buffer Binding 0
        %void = OpTypeVoid
        %bool = OpTypeBool
        %uint = OpTypeInt 32 0
        %function = OpTypeFunction %void
        %yes = OpSpecConstantTrue %bool
        %no = OpSpecConstantFalse %bool
        %seven = OpSpecConstant %uint 7
        %Block = OpTypeStruct %uint
        %BlockPointer = OpTypePointer StorageBuffer %Block
        %UintPointer = OpTypePointer StorageBuffer %uint
        %buffer = OpVariable %BlockPointer StorageBuffer
    )";
    for (int i = 0; i < 10; ++i)
        text += fmt::format("%c{} = OpConstant %uint {}\n", i, i);
    text += declarations + R"(
        %main = OpFunction %void None %function
        %entry = OpLabel
        %word = OpAccessChain %UintPointer %buffer %c0
        %value = OpLoad %uint %word
        %unknown = OpINotEqual %bool %value %c0
    )" + body +
            "\nOpFunctionEnd\n";
    Tools assembler;
    ModuleWords words;
    EXPECT_TRUE(assembler.tools.Assemble(text, &words)) << assembler.messages;
    EXPECT_EQ(errorsIn(words), "") << "before";
    return words;
}

std::string storesOf(const ModuleWords &words) {
    std::map<std::uint32_t, std::string> constants;
    std::string stores;
    for (const gpu::SpirvInstruction &instruction : gpu::instructionsOf(words)) {
        if (instruction.opcode() == spv::Op::OpConstant)
            constants[instruction.words[2]] = fmt::format("{}", instruction.words[3]);
        if (instruction.opcode() == spv::Op::OpPhi && instruction.words.size() == 5)
            if (const auto constant = constants.find(instruction.words[3]); constant != constants.end())
                constants[instruction.words[2]] = constant->second;
        if (instruction.opcode() == spv::Op::OpStore) {
            const auto constant = constants.find(instruction.words[2]);
            stores += (constant == constants.end() ? "?" : constant->second) + " ";
        }
    }
    return stores;
}

} // namespace hyalite::core::testing
