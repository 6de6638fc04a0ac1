// Render configuration: which kernel runs, and how its work is divided into dispatches.
#pragma once

#include "host/gpu/arithmetic.h"
#include "host/gpu/vk/device_list.h"
#include "host/packing/packed_scene.h"
#include "host/scene/settings.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace hyalite::core::gpu {

/// Traversals of the tree. Stack: portable, over storage buffers. SkipList: over texel buffers, which lavapipe reads
/// several times faster.
enum class Traversal { Automatic, Stack, SkipList };

/// How the work of a render is divided and done. No member affects the image.
struct RenderConfig {
    int tileWidth = 0;            ///< pixels, a multiple of 8; 0: by the device
    int tileHeight = 0;           ///< pixels, a multiple of 8; 0: by the device
    std::uint32_t steps = 0;      ///< loop iterations of a path slot in one dispatch; 0: by the device
    int slotsPerInvocation = 0;   ///< path slots of one invocation, 1 or 2; 0: by the device
    double dispatchSeconds = 0.1; ///< wanted time of a dispatch; > 0
    int samplesInFlight = 0;      ///< slots of one pixel: 1, 2, 4 or 8; 0: by the device and the sample count
    bool isStaged = false;        ///< transfer everything through staging buffers
    bool isCounting = false;      ///< count the work of the traversal
    Arithmetic arithmetic = Arithmetic::Automatic; ///< division and square root
    Traversal traversal = Traversal::Automatic;
    /// SPIR-V instead of our kernel, for tests of how a faulty one is found; empty: ours. It has one slot an
    /// invocation and a stack.
    std::span<const std::uint32_t> kernel{};
};

/// Kinds of scenes for which different kernels are fast.
enum class Workload {
    Spheres,   ///< no tree: kernels compute and rarely read
    Triangles, ///< rays go through a tree
    Shading    ///< most code is shading: paths with rough surfaces or an environment
};

inline constexpr std::array<std::pair<std::string_view, Workload>, 3> workloadNames{
    {{"spheres", Workload::Spheres}, {"triangles", Workload::Triangles}, {"shading", Workload::Shading}}};

[[nodiscard]] Workload workloadOf(const PackedScene &scene, Integrator integrator);

/// Fills in every member of `config` that was left to the device.
[[nodiscard]] RenderConfig completed(RenderConfig config, const DeviceInfo &device,
                                     Workload workload = Workload::Triangles);

/// SPIR-V of the kernel for `integrator` and a complete `config`.
[[nodiscard]] std::span<const std::uint32_t> kernelWords(const RenderConfig &config, Integrator integrator);

/// Hash of all kernels: measurements of other kernels do not count.
[[nodiscard]] std::uint64_t hashOfKernels();

/// The part of a kernel that users choose.
struct KernelChoice {
    Traversal traversal = Traversal::Automatic;
    int slotsPerInvocation = 0;
};

/// The preferred kernel for each Workload; Automatic: none.
using KernelChoices = std::array<KernelChoice, workloadNames.size()>;

/// The words for kernels.
inline constexpr std::array<std::pair<std::string_view, KernelChoice>, 5> kernelNames{
    {{"auto", {}},
     {"stack", {Traversal::Stack, 1}},
     {"stack-x2", {Traversal::Stack, 2}},
     {"skip-list", {Traversal::SkipList, 1}},
     {"skip-list-x2", {Traversal::SkipList, 2}}}};

/// All of them but "auto".
inline constexpr std::span namedKernels = std::span(kernelNames).subspan<1>();

/// The word for a kernel.
[[nodiscard]] std::string_view kernelName(const KernelChoice &choice);
/// The word for the kernel of a complete `config`.
[[nodiscard]] std::string_view kernelName(const RenderConfig &config);

} // namespace hyalite::core::gpu
