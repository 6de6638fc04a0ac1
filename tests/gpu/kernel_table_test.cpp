// The table of kernels beside what the build embeds, and the automatic choice.
#include "host/gpu/kernel_needs.h"
#include "host/gpu/kernels.h"
#include "shaders/embedded_kernels.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace hyalite::core::gpu {
namespace {

DeviceInfo device(DeviceType type) {
    DeviceInfo info;
    info.type = type;
    info.maxWorkgroupInvocations = 64;
    info.maxStorageBuffersPerStage = 64;
    info.maxStorageImagesPerStage = 64;
    info.canShuffle = true;
    return info;
}

/// The kernels that are chosen for the workloads, in their order.
std::string chosenOn(const DeviceInfo &info) {
    std::string chosen;
    for (const auto &[name, workload] : workloadNames)
        chosen += fmt::format("{} ", chooseKernel(info, workload).name);
    return chosen;
}

TEST(KernelTable, IsThatOfTheBuild) {
    std::set<std::string_view> modules;
    for (const IntegratorRow &integrator : integratorTable)
        for (const KernelRow &row : kernelTable) {
            const std::string name = moduleName(integrator.kernel, row);
            const auto kernel = std::ranges::find(embeddedKernels(), name, &EmbeddedKernel::name);
            ASSERT_NE(kernel, embeddedKernels().end()) << name;
            modules.insert(kernel->name);
            const std::string definitions = fmt::format("{} ", kernel->definitions);
            for (const std::string &definition :
                 {fmt::format("RAYS={} ", row.raysAtOnce),
                  fmt::format("TRAVERSAL_SKIP_LIST={:d} ", row.tree == KernelTree::SkipLists),
                  fmt::format("TRAVERSAL_RAY_QUERY={:d} ", row.tree == KernelTree::PrimitiveBoxes),
                  fmt::format("TREE_WIDE={:d} ", row.tree == KernelTree::WideNodes),
                  fmt::format("DRIVE_PLAIN={:d} ", row.drive == KernelDrive::Plain),
                  fmt::format("MEMORY_TEXELS={:d} ", row.memory == KernelMemory::Texels),
                  fmt::format("LANES_SHUFFLE={:d} ", row.lanes == KernelLanes::Exchanging)})
                EXPECT_NE(definitions.find(definition), std::string::npos) << name << ": " << definitions;
        }
    for (const EmbeddedKernel &kernel : embeddedKernels())
        EXPECT_EQ(modules.contains(kernel.name), kernel.definitions.find("RAYS=") != std::string_view::npos)
            << kernel.name << " has no row";
}

TEST(KernelTable, IsInTheDocument) {
    std::ostringstream text;
    text << std::ifstream(HYALITE_SOURCE_DIR "/shaders/README.md").rdbuf();
    for (const KernelRow &row : kernelTable)
        EXPECT_NE(text.str().find(fmt::format("`{}`", row.name)), std::string::npos) << row.name;
}

TEST(KernelTable, HasAPlaceForEachKernelThatIsChosen) {
    for (std::size_t workload = 0; workload <= workloadNames.size(); ++workload) {
        std::set<int> places;
        for (const KernelRow &row : kernelTable) {
            const int place =
                workload < workloadNames.size() ? row.suits.software[workload] : row.suits.others;
            EXPECT_TRUE(place == 0 || places.insert(place).second) << row.name << ", " << place;
        }
        EXPECT_TRUE(places.contains(1));
    }
}

TEST(ChooseKernel, TakesWhatSuitsTheDeviceAndTheWorkload) {
    DeviceInfo software = device(DeviceType::Cpu);
    DeviceInfo hardware = device(DeviceType::Discrete);
    EXPECT_EQ(chosenOn(software), "skip-list skip-list-x2 skip-list ");
    EXPECT_EQ(chosenOn(hardware), "skip-list skip-list skip-list ");
    software.canShuffle = false;
    EXPECT_EQ(chosenOn(software), "stack stack stack ");
    hardware.maxStorageImagesPerStage = 8;
    EXPECT_EQ(chosenOn(hardware), "stack stack stack ");
    hardware.maxStorageBuffersPerStage = 8;
    hardware.maxStorageImagesPerStage = 64;
    EXPECT_EQ(chosenOn(hardware), "skip-list skip-list skip-list ");
    hardware.canShuffle = false;
    EXPECT_EQ(chosenOn(hardware), "stack stack stack ") << "that needs the least, and is refused";
    const auto hasTwoRays = [](const KernelRow &row) { return row.raysAtOnce == 2; };
    EXPECT_EQ(chooseKernel(device(DeviceType::Cpu), Workload::Spheres, hasTwoRays).name, "skip-list-x2");
}

TEST(KernelNeeds, LeaveOutSkipListsWhereTheDriverComputesThemWrongly) {
    DeviceInfo info = device(DeviceType::Cpu);
    info.driverId = VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
    EXPECT_EQ(chosenOn(info), "stack stack stack ");
    EXPECT_NE(lackFor(*findKernel("skip-list-x2"), info), "");
    EXPECT_EQ(lackFor(*findKernel("wide"), info), "");
}

TEST(KernelNeeds, NameTheExtensionThatRayQueriesNeed) {
    DeviceInfo info = device(DeviceType::Discrete);
    EXPECT_EQ(lackFor(*findKernel("ray-query"), info), "offers no ray queries (VK_KHR_ray_query)");
    info.maxQueryBoxes = 1;
    EXPECT_EQ(lackFor(*findKernel("ray-query"), info), "");
    EXPECT_TRUE(findKernel("ray-query")->suits.isByNameOn(info));
}

TEST(KernelTable, HasOthersForWordsThatAreGone) {
    for (const auto &[former, present] : formerKernels) {
        EXPECT_EQ(findKernel(former), nullptr) << former;
        EXPECT_NE(findKernel(present), nullptr) << present;
        EXPECT_EQ(presentKernel(former), present);
    }
    EXPECT_EQ(presentKernel("skip-list"), "skip-list");
}

} // namespace
} // namespace hyalite::core::gpu
