#include "host/gpu/vk/float_controls.h"

#include "host/gpu/spirv/instructions.h"

#include <array>

namespace hyalite::core::gpu {

namespace {

/// A capability and the execution mode that it permits.
struct Control {
    spv::Capability capability;
    spv::ExecutionMode executionMode;
};
constexpr std::uint32_t floatWidth = 32;

void appendExtension(std::vector<std::uint32_t> &words) {
    constexpr char name[] = "SPV_KHR_float_controls";
    std::array<std::uint32_t, (sizeof(name) + 3) / 4> packed{};
    for (std::size_t i = 0; i < sizeof(name); ++i)
        packed[i / 4] |= static_cast<std::uint32_t>(name[i]) << (i % 4 * 8);
    append(words, spv::Op::OpExtension, packed);
}

} // namespace

std::vector<std::uint32_t> addFloatControls(std::span<const std::uint32_t> spirv,
                                            const FloatControls &controls) {
    std::vector<Control> wanted;
    if (controls.canPreserveSignedZeroInfNan)
        wanted.push_back(
            {spv::Capability::SignedZeroInfNanPreserve, spv::ExecutionMode::SignedZeroInfNanPreserve});
    if (controls.canRoundToNearestEven)
        wanted.push_back({spv::Capability::RoundingModeRTE, spv::ExecutionMode::RoundingModeRTE});
    if (wanted.empty())
        return {spirv.begin(), spirv.end()};

    std::vector<std::uint32_t> words(spirv.begin(), spirv.begin() + spirvHeaderWords);
    std::vector<std::uint32_t> entryPoints;
    bool isInCapabilities = true;
    bool areModesWritten = false;
    for (const SpirvInstruction &instruction : instructionsOf(spirv)) {
        const spv::Op opcode = instruction.opcode();
        if (isInCapabilities && opcode != spv::Op::OpCapability) {
            isInCapabilities = false;
            for (const Control &control : wanted)
                append(words, spv::Op::OpCapability, {static_cast<std::uint32_t>(control.capability)});
            appendExtension(words);
        }
        if (opcode == spv::Op::OpEntryPoint)
            entryPoints.push_back(instruction.words[2]);
        if (!entryPoints.empty() && opcode != spv::Op::OpEntryPoint && !areModesWritten) {
            areModesWritten = true;
            for (const std::uint32_t entryPoint : entryPoints)
                for (const Control &control : wanted)
                    append(words, spv::Op::OpExecutionMode,
                           {entryPoint, static_cast<std::uint32_t>(control.executionMode), floatWidth});
        }
        words.insert(words.end(), instruction.words.begin(), instruction.words.end());
    }
    return words;
}

} // namespace hyalite::core::gpu
