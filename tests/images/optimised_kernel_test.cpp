// Drivers optimise what we give them, each in its own way. spirv-opt stands for all of them: it inlines, folds,
// reorders and removes, as far as SPIR-V allows it. What it makes of our kernels must compute the same bits.
#include "tests/fixtures/temporary_folder.h"
#include "tests/fixtures/test_extent.h"
#include "tests/images/rendering.h"

#include "whittedSkipOneSlot.h"
#include "whittedSkipTwoSlots.h"
#include "whittedStackOneSlot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace hyalite::core {
namespace {

using Words = std::vector<std::uint32_t>;

/// What `spirv-opt -O` makes of a kernel.
Words optimise(std::span<const std::uint32_t> kernel) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path before = folder.path / "before.spv";
    const std::filesystem::path after = folder.path / "after.spv";
    const auto sizeBytes = [](std::size_t words) {
        return static_cast<std::streamsize>(words * sizeof(std::uint32_t));
    };
    std::ofstream(before, std::ios::binary)
        .write(reinterpret_cast<const char *>(kernel.data()), sizeBytes(kernel.size()));
    const std::string command = fmt::format("'{}' --target-env=vulkan1.1 -O '{}' -o '{}'", HYALITE_SPIRV_OPT,
                                            before.string(), after.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    Words words(std::filesystem::file_size(after) / sizeof(std::uint32_t));
    std::ifstream(after, std::ios::binary)
        .read(reinterpret_cast<char *>(words.data()), sizeBytes(words.size()));
    return words;
}

/// On mirrors, nested glass and triangles.
void expectSameBits(std::span<const std::uint32_t> kernel, gpu::RenderConfig config) {
    const Words optimised = optimise(kernel);
    ASSERT_GT(optimised.size(), 1000u);
    ASSERT_NE(optimised, Words(kernel.begin(), kernel.end())) << "nothing was optimised";
    config.spirv = optimised;
    for (const char *name : {"spheres-nested", "cat"}) {
        const TestScene scene = testing::shippedScene(name, 96, 64, 2);
        const gpu::Result device = testing::renderOnDevice(scene, config);
        const reference::Result cpu = testing::renderOnCpu(scene);
        EXPECT_EQ(testing::differingPixels(device.film, cpu.film), 0u) << name;
        EXPECT_EQ(device.rays, cpu.rays) << name;
    }
}

TEST(OptimisedKernel, OfTheStackComputesTheSameBits) {
    expectSameBits(whittedStackOneSlot,
                   {.arithmetic = gpu::Arithmetic::Own, .kernel = gpu::findKernel("stack")});
}

TEST(OptimisedKernel, OfTheSkipListComputesTheSameBits) {
    if (!testing::isTestingAll())
        GTEST_SKIP() << "for minutes of spirv-opt";
    expectSameBits(whittedSkipOneSlot, {.kernel = gpu::findKernel("skip-list")});
    if (testing::isTestingAll())
        expectSameBits(whittedSkipTwoSlots,
                       {.arithmetic = gpu::Arithmetic::Own, .kernel = gpu::findKernel("skip-list-x2")});
}

} // namespace
} // namespace hyalite::core
