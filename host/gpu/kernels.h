// The kernels: a row for each way through the tree and the memory. Code that depends on the choice asks the row.
#pragma once

#include "host/gpu/vk/device_list.h"
#include "host/packing/packed_scene.h"
#include "host/scene/settings.h"

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace hyalite::core::gpu {

/// Kinds of scenes for which different kernels are fast.
enum class Workload {
    Spheres,   ///< no tree: kernels compute and rarely read
    Triangles, ///< rays go through a tree
    Shading    ///< most code is shading: paths with rough surfaces or an environment
};

inline constexpr std::array<std::pair<std::string_view, Workload>, 3> workloadNames{
    {{"spheres", Workload::Spheres}, {"triangles", Workload::Triangles}, {"shading", Workload::Shading}}};

[[nodiscard]] Workload workloadOf(const PackedScene &scene, Integrator integrator);

/// The tree in device memory.
enum class KernelTree {
    NodePairs,     ///< that of the packed scene
    WideNodes,     ///< made of it for the device: up to eight children a node
    SkipLists,     ///< made of it for the device. Triangles are tested in pairs; few triangles have no tree
    PrimitiveBoxes ///< the device's own, for ray queries
};

/// What a kernel reads the scene through.
enum class KernelMemory {
    StorageBuffers,
    Texels ///< storage texel buffers, which lavapipe reads several times faster
};

/// The lanes of a subgroup.
enum class KernelLanes {
    Independent, ///< a slot takes the samples of its pixel one by one
    Exchanging   ///< samples of a pixel lie side by side, and dispatches end with whole samples
};

/// In what order the rays of paths are traced.
enum class KernelDrive {
    Staged, ///< all lanes are in the same stage, as a CPU pays for each that any lane is in
    Plain   ///< a lane goes on with whatever its path asks for next
};

/// Places in the automatic choice, 1 before 2; 0: a kernel that runs only by its name.
struct KernelSuits {
    std::array<int, workloadNames.size()> software; ///< devices that compute on the CPU, by Workload
    int others;

    [[nodiscard]] int placeOn(const DeviceInfo &device, Workload workload) const {
        return device.isSoftware() ? software[static_cast<std::size_t>(workload)] : others;
    }
    /// Whether such a device has it by its name alone.
    [[nodiscard]] bool isByNameOn(const DeviceInfo &device) const {
        return std::ranges::all_of(
            workloadNames, [&](const auto &workload) { return placeOn(device, workload.second) == 0; });
    }
};

struct KernelRow {
    std::string_view name;  ///< the word for it, here and in files
    std::string_view trace; ///< its traversal, in the names of SPIR-V modules
    KernelTree tree;
    bool hasStack; ///< one for each slot, in a buffer
    KernelMemory memory;
    KernelLanes lanes;
    KernelDrive drive;
    int raysAtOnce; ///< path slots of an invocation, 1 or 2
    KernelSuits suits;
};

/// shaders/CMakeLists.txt has a row for each (tests/gpu/kernel_table_test.cpp compares both). The first one needs the
/// least of a device.
///
/// On the only GPU that was measured, skip lists are 1.7 to 3.5 times as fast as stacks in seven of nine scenes, and as
/// fast in two: eight samples of a pixel side by side fill the card, with coherent rays. Other subgroups hide the latency
/// of memory there. On a CPU two rays at once do, where there is a tree without a stack; elsewhere they are only more
/// code (tests/bench/README.md). Where shading searches, lavapipe does not unroll the loop over slots around it and
/// keeps slots in memory: 6 times slower, 20 times with textures. Unrolled by us, two slots gain nothing there, and
/// pipelines take longer.
inline constexpr auto kernelTable = std::to_array<KernelRow>({
    {.name = "stack",
     .trace = "Stack",
     .tree = KernelTree::NodePairs,
     .hasStack = true,
     .memory = KernelMemory::StorageBuffers,
     .lanes = KernelLanes::Independent,
     .drive = KernelDrive::Staged,
     .raysAtOnce = 1,
     .suits = {.software = {3, 3, 3}, .others = 2}},
    {.name = "wide",
     .trace = "Wide",
     .tree = KernelTree::WideNodes,
     .hasStack = true,
     .memory = KernelMemory::StorageBuffers,
     .lanes = KernelLanes::Independent,
     .drive = KernelDrive::Plain,
     .raysAtOnce = 1,
     .suits = {.software = {0, 0, 0}, .others = 4}},
    {.name = "ray-query",
     .trace = "Query",
     .tree = KernelTree::PrimitiveBoxes,
     .hasStack = false,
     .memory = KernelMemory::StorageBuffers,
     .lanes = KernelLanes::Independent,
     .drive = KernelDrive::Plain,
     .raysAtOnce = 1,
     .suits = {.software = {0, 0, 0}, .others = 0}},
    {.name = "skip-list",
     .trace = "Skip",
     .tree = KernelTree::SkipLists,
     .hasStack = false,
     .memory = KernelMemory::Texels,
     .lanes = KernelLanes::Exchanging,
     .drive = KernelDrive::Staged,
     .raysAtOnce = 1,
     .suits = {.software = {1, 2, 1}, .others = 1}},
    {.name = "skip-list-x2",
     .trace = "Skip",
     .tree = KernelTree::SkipLists,
     .hasStack = false,
     .memory = KernelMemory::Texels,
     .lanes = KernelLanes::Exchanging,
     .drive = KernelDrive::Staged,
     .raysAtOnce = 2,
     .suits = {.software = {2, 1, 2}, .others = 3}},
});

/// The words for kernels; null: by device and scene.
inline constexpr auto kernelNames = [] {
    std::array<std::pair<std::string_view, const KernelRow *>, 1 + kernelTable.size()> names{
        {{"auto", nullptr}}};
    for (std::size_t i = 0; i < kernelTable.size(); ++i)
        names[1 + i] = {kernelTable[i].name, &kernelTable[i]};
    return names;
}();

/// All of them but "auto".
inline constexpr std::span namedKernels = std::span(kernelNames).subspan<1>();

/// Words of kernels that are gone, and those of the kernels in their places. They hold until the next version.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 1> formerKernels{
    {{"stack-x2", "stack"}}};

/// The word itself, or that of the kernel in its place.
[[nodiscard]] constexpr std::string_view presentKernel(std::string_view name) {
    for (const auto &[former, present] : formerKernels)
        if (former == name)
            return present;
    return name;
}

/// The row of a word; null for "auto", and if there is none.
[[nodiscard]] constexpr const KernelRow *findKernel(std::string_view name) {
    for (const auto &[word, row] : kernelNames)
        if (word == name)
            return row;
    return nullptr;
}

/// The word for a kernel; "auto" for null.
[[nodiscard]] constexpr std::string_view kernelName(const KernelRow *kernel) {
    return kernel != nullptr ? kernel->name : "auto";
}

/// The name of the SPIR-V module of a program such as `path` by this kernel: `pathSkipTwoSlots`.
[[nodiscard]] std::string moduleName(std::string_view program, const KernelRow &kernel);

/// Whether the work of its traversal is that of the cost, which the CPU counts too.
[[nodiscard]] constexpr bool countsCost(const KernelRow &kernel) {
    return kernel.tree == KernelTree::NodePairs;
}

/// Whether rays go through the tree with a stack: one of ours, or the device's own.
[[nodiscard]] constexpr bool walksWithStack(const KernelRow &kernel) {
    return kernel.hasStack || kernel.tree == KernelTree::PrimitiveBoxes;
}

/// Whether both read the same buffers of a scene.
[[nodiscard]] constexpr bool shareScenes(const KernelRow &a, const KernelRow &b) {
    return a.tree == b.tree && a.memory == b.memory;
}

/// The kernel that suits the device and the workload best, among those that are allowed (all, if `isAllowed` is empty)
/// and that the device can run. If it can run none, the first that is allowed.
[[nodiscard]] const KernelRow &chooseKernel(const DeviceInfo &device, Workload workload,
                                            const std::function<bool(const KernelRow &)> &isAllowed = {});

} // namespace hyalite::core::gpu
