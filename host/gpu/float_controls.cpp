#include "host/gpu/float_controls.h"

#include <cassert>

namespace hyalite::gpu {

namespace {

// SPIR-V 1.3, sections 2.3 (a module is a header and instructions), 2.4 (their order) and 3 (the numbers);
// SPV_KHR_float_controls for the rest.
constexpr std::size_t headerWords = 5;
constexpr std::uint32_t opExtension = 10;
constexpr std::uint32_t opEntryPoint = 15;
constexpr std::uint32_t opExecutionMode = 16;
constexpr std::uint32_t opCapability = 17;

/// A capability and the execution mode that it permits.
struct Control {
    std::uint32_t capability;
    std::uint32_t executionMode;
};
constexpr Control signedZeroInfNanPreserve{4466, 4461};
constexpr Control roundingModeRte{4467, 4462};
constexpr std::uint32_t floatWidth = 32;

constexpr std::uint32_t instruction(std::uint32_t opcode, std::uint32_t wordCount) {
    return wordCount << 16 | opcode;
}

void appendExtension(std::vector<std::uint32_t> &words) {
    constexpr char name[] = "SPV_KHR_float_controls";
    constexpr std::size_t nameWords = (sizeof(name) + 3) / 4;
    words.push_back(instruction(opExtension, 1 + nameWords));
    std::uint32_t packed[nameWords]{};
    for (std::size_t i = 0; i < sizeof(name); ++i)
        packed[i / 4] |= static_cast<std::uint32_t>(name[i]) << (i % 4 * 8);
    words.insert(words.end(), packed, packed + nameWords);
}

} // namespace

std::vector<std::uint32_t> addFloatControls(std::span<const std::uint32_t> spirv,
                                            const FloatControls &controls) {
    std::vector<Control> wanted;
    if (controls.canPreserveSignedZeroInfNan)
        wanted.push_back(signedZeroInfNanPreserve);
    if (controls.canRoundToNearestEven)
        wanted.push_back(roundingModeRte);
    if (wanted.empty())
        return {spirv.begin(), spirv.end()};

    assert(spirv.size() > headerWords);
    std::vector<std::uint32_t> words(spirv.begin(), spirv.begin() + headerWords);
    std::vector<std::uint32_t> entryPoints;
    bool isInCapabilities = true;
    bool areModesWritten = false;
    for (std::size_t at = headerWords; at < spirv.size();) {
        const std::uint32_t opcode = spirv[at] & 0xFFFFu;
        const std::size_t length = spirv[at] >> 16;
        assert(length > 0 && at + length <= spirv.size());
        if (isInCapabilities && opcode != opCapability) {
            isInCapabilities = false;
            for (const Control &control : wanted)
                words.insert(words.end(), {instruction(opCapability, 2), control.capability});
            appendExtension(words);
        }
        if (opcode == opEntryPoint)
            entryPoints.push_back(spirv[at + 2]);
        if (!entryPoints.empty() && opcode != opEntryPoint && !areModesWritten) {
            areModesWritten = true;
            for (const std::uint32_t entryPoint : entryPoints)
                for (const Control &control : wanted)
                    words.insert(words.end(), {instruction(opExecutionMode, 4), entryPoint,
                                               control.executionMode, floatWidth});
        }
        words.insert(words.end(), spirv.begin() + static_cast<std::ptrdiff_t>(at),
                     spirv.begin() + static_cast<std::ptrdiff_t>(at + length));
        at += length;
    }
    return words;
}

} // namespace hyalite::gpu
