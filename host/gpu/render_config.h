// How work is cut into dispatches, and which kernel does it.
#pragma once

#include "host/gpu/arithmetic.h"
#include "host/gpu/vk/device_list.h"
#include "host/packing/packed_scene.h"
#include "host/scene/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace hyalite::gpu {

/// How rays go through the tree. Stack: the portable one, over storage buffers. SkipList: over texel buffers, which
/// lavapipe reads several times faster.
enum class Traversal { Automatic, Stack, SkipList };

/// How work is cut into dispatches, and what for. The image does not depend on any of it.
struct RenderConfig {
    int tileWidth = 0;            ///< pixels, a multiple of 8; 0: by the device
    int tileHeight = 0;           ///< pixels, a multiple of 8; 0: by the device
    std::uint32_t steps = 0;      ///< loop iterations of a path slot in one dispatch; 0: by the device
    int slotsPerInvocation = 0;   ///< path slots of one invocation, 1 or 2; 0: by the device
    double dispatchSeconds = 0.1; ///< how long a dispatch should take; > 0
    int samplesAbreast = 0;  ///< slots of one pixel: 1, 2, 4 or 8; 0: by the device and the samples wanted
    bool isStaged = false;   ///< transfer everything through staging buffers
    bool isCounting = false; ///< count the work of the traversal
    Arithmetic arithmetic = Arithmetic::Automatic; ///< which / and sqrt run
    Traversal traversal = Traversal::Automatic;
    /// SPIR-V to run in place of our kernel, to see how a faulty one is found; empty: ours. One slot an
    /// invocation, and the stack.
    std::span<const std::uint32_t> kernel{};
};

/// Kinds of scenes for which different kernels are fast.
enum class Workload {
    Spheres,   ///< there are no triangles: kernels compute, and hardly read
    Triangles, ///< rays go through a tree
    Shading ///< most code is about what happens where rays arrive: paths with rough surfaces or an environment
};

inline constexpr std::array<std::pair<std::string_view, Workload>, 3> workloadNames{
    {{"spheres", Workload::Spheres}, {"triangles", Workload::Triangles}, {"shading", Workload::Shading}}};

[[nodiscard]] Workload workloadOf(const PackedScene &scene, Integrator integrator);

/// `config` with everything filled in that was left to the device.
[[nodiscard]] RenderConfig completed(RenderConfig config, const DeviceInfo &device,
                                     Workload workload = Workload::Triangles);

/// The kernel of `integrator` that a complete `config` names, as SPIR-V.
[[nodiscard]] std::span<const std::uint32_t> kernelWords(const RenderConfig &config, Integrator integrator);

/// Of all kernels together: what was measured of others does not hold.
[[nodiscard]] std::uint64_t hashOfKernels();

/// A kernel that can be asked for.
struct KernelChoice {
    Traversal traversal = Traversal::Automatic;
    int slotsPerInvocation = 0;
};

/// For each Workload; Automatic where there is nothing to prefer.
using KernelChoices = std::array<KernelChoice, workloadNames.size()>;

/// By the words that command lines use.
inline constexpr std::array<std::pair<std::string_view, KernelChoice>, 5> kernelNames{
    {{"auto", {}},
     {"stack", {Traversal::Stack, 1}},
     {"stack-x2", {Traversal::Stack, 2}},
     {"skip-list", {Traversal::SkipList, 1}},
     {"skip-list-x2", {Traversal::SkipList, 2}}}};

/// Those that are kernels.
inline constexpr std::span namedKernels = std::span(kernelNames).subspan<1>();

/// The word for a kernel.
[[nodiscard]] std::string_view kernelName(const KernelChoice &choice);
/// The word for the kernel of a complete `config`.
[[nodiscard]] std::string_view kernelName(const RenderConfig &config);

} // namespace hyalite::gpu
