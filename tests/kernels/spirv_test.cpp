// What our kernels may consist of, so that every device computes the same bits; and the float controls that the host
// adds to them.
#include "host/base/hash.h"
#include "host/gpu/render_config.h"
#include "host/gpu/vk/float_controls.h"
#include "shaders/layout/layout.h"
#include "tests/kernels/all_kernels.h"
#include "tests/kernels/spirv_module.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyalite::core::testing {
namespace {

/// Whether the kernel's functions are as they were written: others are optimised, and all of it is in `main`.
bool isUnoptimised(const EmbeddedKernel &kernel) { return kernel.name.starts_with("unoptimised"); }

/// Where the device's own / and sqrt may stand in an unoptimised kernel: behind hasExactDivision, or corrected with
/// integers.
bool mayDivide(const Instruction &instruction) {
    return instruction.function.starts_with("divide(") || instruction.function.starts_with("squareRoot(") ||
           instruction.function.starts_with("divideSmall(");
}

TEST(EmbeddedKernels, AreAllListed) {
    for (const char *name : {"startupCheck", "whittedStackOneSlot", "pathSkipTwoSlots", "probeKernel",
                             "unoptimisedStack", "unoptimisedSkipList"})
        EXPECT_EQ(std::ranges::count(allKernels(), name, &EmbeddedKernel::name), 1) << name;
}

TEST(EmbeddedKernels, HaveTheirHashes) {
    for (const EmbeddedKernel &kernel : allKernels())
        EXPECT_EQ(kernel.hash, hashBytes(std::as_bytes(kernel.words.get()))) << kernel.name;
}

TEST(EmbeddedKernels, UseExactOperationsOnly) {
    // GLSL.std.450 instructions whose results are exact: FAbs, SAbs, Floor, FMin, UMin, SMin, FMax, UMax, SMax, FClamp,
    // UClamp, SClamp, FindILsb, FindSMsb, FindUMsb.
    const std::set<std::uint32_t> exact{4, 5, 8, 37, 38, 39, 40, 41, 42, 43, 44, 45, 73, 74, 75};
    constexpr std::uint32_t sqrtNumber = 31;
    const std::set<spv::Op> withoutOrder{spv::Op::OpDot,
                                         spv::Op::OpVectorTimesMatrix,
                                         spv::Op::OpMatrixTimesVector,
                                         spv::Op::OpMatrixTimesMatrix,
                                         spv::Op::OpFRem,
                                         spv::Op::OpFMod};
    for (const EmbeddedKernel &kernel : allKernels()) {
        std::size_t nativeCount = 0;
        const SpirvModule module(kernel.words);
        for (const Instruction &instruction : module.instructions) {
            const auto where = [&] { return std::string(kernel.name) + ", in " + instruction.function; };
            EXPECT_FALSE(withoutOrder.contains(instruction.opcode))
                << "opcode " << static_cast<int>(instruction.opcode) << ": " << where();
            const bool isExtended = instruction.opcode == spv::Op::OpExtInst;
            const bool isNative = instruction.opcode == spv::Op::OpFDiv ||
                                  (isExtended && instruction.operands[3] == sqrtNumber);
            nativeCount += isNative ? 1u : 0u;
            if (isNative && isUnoptimised(kernel)) {
                EXPECT_TRUE(mayDivide(instruction)) << "the device's own / or sqrt: " << where();
            } else if (isExtended && !isNative) {
                EXPECT_TRUE(exact.contains(instruction.operands[3]))
                    << "GLSL.std.450 instruction " << instruction.operands[3] << ": " << where();
            }
        }
        // The same check sees them where they are.
        if (isUnoptimised(kernel)) {
            EXPECT_EQ(nativeCount, 3u) << kernel.name;
        }
    }
}

// ---- Constants

TEST(EmbeddedKernels, KnowTheConstantsOfTheirDuties) {
    // Constants that a module does not have are ignored: the wrong kernel would do without what it was told.
    for (const Integrator integrator : {Integrator::Whitted, Integrator::Path, Integrator::Cost}) {
        for (const gpu::KernelRow &kernel : gpu::kernelTable) {
            std::set<std::uint32_t> known;
            for (const Instruction &instruction :
                 SpirvModule(gpu::kernelWords({.kernel = &kernel}, integrator)).instructions)
                if (instruction.opcode == spv::Op::OpDecorate &&
                    instruction.operands[1] == static_cast<std::uint32_t>(spv::Decoration::SpecId))
                    known.insert(instruction.operands[2]);
            for (const std::uint32_t id :
                 {layout::constantCamera, layout::constantTexturing, layout::constantScattering,
                  layout::constantLighting, layout::constantShowsCost, layout::constantIsCounting,
                  layout::constantIsTracing, layout::constantIsResumable, layout::constantExactDivision})
                EXPECT_TRUE(known.contains(id)) << "integrator " << static_cast<int>(integrator) << ", "
                                                << kernel.name << ", constant " << id;
        }
    }
}

// ---- Float controls

struct ControlsCase {
    gpu::FloatControls controls;
    std::vector<std::uint32_t> capabilities;
    std::vector<std::uint32_t> modes;
};

const ControlsCase controlsCases[] = {
    {{true, true}, {4466, 4467}, {4461, 4462}},
    {{true, false}, {4467}, {4462}},
    {{false, true}, {4466}, {4461}},
};

TEST(FloatControls, AreAddedInTheirSections) {
    for (const EmbeddedKernel &kernel : allKernels()) {
        for (const auto &[controls, capabilities, modes] : controlsCases) {
            const std::vector<std::uint32_t> words = gpu::addFloatControls(kernel.words, controls);
            const SpirvModule module(words);
            std::vector<std::uint32_t> addedCapabilities;
            std::vector<std::uint32_t> addedModes;
            std::size_t extensionCount = 0;
            std::uint32_t entryPoint = 0;
            // The order of sections in a module, as far as it concerns us.
            int section = 0;
            for (const Instruction &instruction : module.instructions) {
                const int wanted = instruction.opcode == spv::Op::OpCapability      ? 0
                                   : instruction.opcode == spv::Op::OpExtension     ? 1
                                   : instruction.opcode == spv::Op::OpEntryPoint    ? 2
                                   : instruction.opcode == spv::Op::OpExecutionMode ? 3
                                                                                    : section;
                EXPECT_GE(wanted, section)
                    << kernel.name << ": opcode " << static_cast<int>(instruction.opcode);
                section = wanted;
                if (instruction.opcode == spv::Op::OpEntryPoint)
                    entryPoint = instruction.operands[1];
                if (instruction.opcode == spv::Op::OpExtension)
                    ++extensionCount;
                if (instruction.opcode == spv::Op::OpCapability && instruction.operands[0] >= 4464 &&
                    instruction.operands[0] != static_cast<std::uint32_t>(spv::Capability::RayQueryKHR))
                    addedCapabilities.push_back(instruction.operands[0]);
                if (instruction.opcode == spv::Op::OpExecutionMode && instruction.operands[1] >= 4459) {
                    EXPECT_EQ(instruction.operands[0], entryPoint);
                    addedModes.push_back(instruction.operands[1]);
                    EXPECT_EQ(instruction.operands[2], 32u);
                }
            }
            EXPECT_EQ(addedCapabilities, capabilities) << kernel.name;
            EXPECT_EQ(addedModes, modes) << kernel.name;
            const auto extensionsBefore = std::ranges::count(SpirvModule(kernel.words).instructions,
                                                             spv::Op::OpExtension, &Instruction::opcode);
            EXPECT_EQ(extensionCount, 1u + static_cast<std::size_t>(extensionsBefore)) << kernel.name;
        }
    }
}

TEST(FloatControls, LeaveTheRestAsItIs) {
    for (const EmbeddedKernel &kernel : allKernels()) {
        const std::span<const std::uint32_t> given = kernel.words;
        const std::vector<std::uint32_t> original(given.begin(), given.end());
        EXPECT_EQ(gpu::addFloatControls(kernel.words, {}), original);
        const std::vector<std::uint32_t> words = gpu::addFloatControls(kernel.words, {true, true});
        // Two capabilities of 2 words, an extension of 7, two modes of 4.
        ASSERT_EQ(words.size(), original.size() + 4 + 7 + 8);
        EXPECT_TRUE(std::equal(original.begin(), original.begin() + 5, words.begin())) << "the header";
        const auto half = static_cast<std::ptrdiff_t>(original.size() / 2);
        EXPECT_TRUE(std::equal(original.rbegin(), original.rbegin() + half, words.rbegin())) << "the code";
    }
}

} // namespace
} // namespace hyalite::core::testing
