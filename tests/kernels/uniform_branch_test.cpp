// No branch of our kernels depends on uniform values alone. lavapipe (Mesa 22.3) writes the values of such branches
// into the code and lowers the kernel anew for each dispatch: a search whose length came from the width of an
// environment made renders 2 to 10 times slower.
#include "host/gpu/kernels.h"
#include "host/gpu/spirv/specialise.h"

#include "host/gpu/spirv/instructions.h"
#include "shaders/layout/layout.h"
#include "tests/kernels/all_kernels.h"
#include "tests/kernels/drawn_constants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

/// What a result depends on.
struct Source {
    bool isUniform = false; ///< uniform buffers or push constants, or the kernel's own copies of these
    bool isVarying = false; ///< what may be another for each invocation
    bool operator==(const Source &) const = default;
};

class DataFlow {
  public:
    explicit DataFlow(std::span<const std::uint32_t> kernel)
        : words_(kernel.begin(), kernel.end()), instructions_(gpu::instructionsOf(words_)),
          sources_(kernel[gpu::spirvBoundWord]) {
        readVariables();
        while (propagate()) {
        }
    }

    /// How many branches and switches depend on uniform values alone, and how many there are.
    [[nodiscard]] std::pair<int, int> countBranches() const {
        std::pair<int, int> count{0, 0};
        for (const gpu::SpirvInstruction &instruction : instructions_) {
            if (instruction.opcode() != spv::Op::OpBranchConditional &&
                instruction.opcode() != spv::Op::OpSwitch)
                continue;
            const Source &condition = sources_[instruction.words[1]];
            count.first += condition.isUniform && !condition.isVarying ? 1 : 0;
            ++count.second;
        }
        return count;
    }

  private:
    void readVariables() {
        // Of bindings.glsl and preloaded.glsl. All other memory may hold anything.
        const std::set<std::string> copies{"frame", "dispatch", "sphereShapes", "transmissiveSpheres",
                                           "firstLight"};
        std::map<std::uint32_t, std::string> names;
        for (const gpu::SpirvInstruction &instruction : instructions_) {
            const auto words = instruction.words;
            if (instruction.opcode() == spv::Op::OpName)
                names[words[1]] = reinterpret_cast<const char *>(&words[2]);
            if (instruction.opcode() != spv::Op::OpVariable)
                continue;
            const auto storage = static_cast<spv::StorageClass>(words[3]);
            const std::string &name = names[words[2]];
            const bool isUniform = storage == spv::StorageClass::Uniform ||
                                   storage == spv::StorageClass::PushConstant || copies.contains(name);
            sources_[words[2]] = {isUniform, !isUniform};
        }
    }

    /// The words of an instruction with a result that are ids it depends on.
    static std::span<const std::uint32_t> operandsOf(const gpu::SpirvInstruction &instruction) {
        switch (instruction.opcode()) {
        case spv::Op::OpExtInst:
            return instruction.words.subspan(5);
        case spv::Op::OpCompositeExtract:
        case spv::Op::OpLoad:
            return instruction.words.subspan(3, 1);
        case spv::Op::OpCompositeInsert:
        case spv::Op::OpVectorShuffle:
            return instruction.words.subspan(3, 2);
        default:
            return instruction.words.size() > 3 ? instruction.words.subspan(3)
                                                : std::span<const std::uint32_t>();
        }
    }

    /// Returns whether something new came out.
    bool propagate() {
        bool hasChanged = false;
        bool isLoopHeader = false;
        bool isCode = false;
        for (std::size_t i = 0; i < instructions_.size(); ++i) {
            const gpu::SpirvInstruction &instruction = instructions_[i];
            const spv::Op opcode = instruction.opcode();
            isCode = isCode || opcode == spv::Op::OpFunction;
            if (opcode == spv::Op::OpLabel)
                isLoopHeader = headsLoop(i);
            const std::uint32_t result = instruction.result();
            if (!isCode || result == 0 || opcode == spv::Op::OpVariable || opcode == spv::Op::OpLabel)
                continue;
            Source source;
            source.isVarying =
                opcode == spv::Op::OpImageRead || (opcode == spv::Op::OpPhi && !isLoopHeader) ||
                (opcode >= spv::Op::OpAtomicLoad && opcode <= spv::Op::OpAtomicXor) ||
                (opcode >= spv::Op::OpGroupNonUniformElect && opcode <= spv::Op::OpGroupNonUniformQuadSwap);
            for (const std::uint32_t id : operandsOf(instruction)) {
                source.isUniform = source.isUniform || (id < sources_.size() && sources_[id].isUniform);
                source.isVarying = source.isVarying || (id < sources_.size() && sources_[id].isVarying);
            }
            hasChanged = hasChanged || source != sources_[result];
            sources_[result] = source;
        }
        return hasChanged;
    }

    /// Whether the block has a loop merge instruction that begins with this label.
    [[nodiscard]] bool headsLoop(std::size_t label) const {
        for (std::size_t i = label + 1; i < instructions_.size(); ++i) {
            if (instructions_[i].opcode() == spv::Op::OpLoopMerge)
                return true;
            if (instructions_[i].opcode() == spv::Op::OpLabel ||
                instructions_[i].opcode() == spv::Op::OpFunctionEnd)
                return false;
        }
        return false;
    }

    std::vector<std::uint32_t> words_;
    std::vector<gpu::SpirvInstruction> instructions_;
    std::vector<Source> sources_; // by id
};

/// Constants for scenes with everything, or of some scene, on a device that divides exactly.
std::vector<std::uint32_t> constantsOf(std::uint32_t camera, bool hasEverything, std::mt19937 &random) {
    std::vector<std::uint32_t> constants = drawnConstants(random);
    if (hasEverything) {
        constants.assign(constants.size(), 1);
        constants[layout::constantWorkgroupSize] = 64;
        constants[layout::constantSamplesInFlight] = 8;
        constants[layout::constantSampler] = layout::samplerFiltered;
        constants[layout::constantScattering] = ~0u;
        constants[layout::constantLighting] = ~0u;
        constants[layout::constantTexturing] = ~0u;
    }
    constants[layout::constantCamera] = camera;
    constants[layout::constantExactDivision] = 1;
    return constants;
}

TEST(UniformBranches, AreInNoKernel) {
    std::mt19937 random(1);
    std::size_t kernelCount = 0;
    for (const EmbeddedKernel &kernel : allKernels()) {
        if (!kernel.name.starts_with("whitted") && !kernel.name.starts_with("path") &&
            !kernel.name.starts_with("view"))
            continue;
        ++kernelCount;
        for (const std::uint32_t camera :
             {layout::cameraPinhole, layout::cameraLens, layout::cameraOrthographic, layout::cameraPanorama,
              layout::cameraLens | layout::cameraOriginsMeetGlass}) {
            for (int i = 0; i < 6; ++i) {
                const auto words = gpu::specialise(kernel.words, constantsOf(camera, i == 0, random));
                const auto [uniform, all] = DataFlow(words).countBranches();
                EXPECT_EQ(uniform, 0) << kernel.name << ", camera " << camera << ", draw " << i;
                EXPECT_GT(all, 10) << kernel.name;
            }
        }
    }
    EXPECT_EQ(kernelCount, 3 * gpu::kernelTable.size());
}

TEST(UniformBranches, AreFoundWhereTheyAre) {
    // Our own division looks at the exponents of an image's size. Without names of variables none would be found.
    const std::span<const std::uint32_t> kernel = embeddedKernel("viewSkipOneSlot");
    EXPECT_GT(DataFlow(kernel).countBranches().first, 0);
}

} // namespace
} // namespace hyalite::core::testing
