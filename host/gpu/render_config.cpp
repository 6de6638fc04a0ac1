#include "host/gpu/render_config.h"

#include "host/base/hash.h"
#include "host/gpu/kernel_needs.h"

#include "shaders/embedded_kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>

namespace hyalite::core::gpu {

Workload workloadOf(const PackedScene &scene, Integrator integrator) {
    if (rowOf(integrator).aimsAtEmitters &&
        (scene.scattering != 0 || (scene.lighting & layout::lightsByEnvironment) != 0))
        return Workload::Shading;
    return scene.needsTree(integrator) ? Workload::Triangles : Workload::Spheres;
}

RenderConfig completed(RenderConfig config, const DeviceInfo &device, Workload workload) {
    // A software device has few cores; a GPU needs many invocations.
    const int side = device.isSoftware() ? 256 : 512;
    if (config.tileWidth == 0)
        config.tileWidth = side;
    if (config.tileHeight == 0)
        config.tileHeight = side;
    // On a CPU two independent rays hide the latency of nodes; without a tree they are only more code. Where shading
    // searches, lavapipe does not unroll the loop over slots around it and keeps slots in memory: 6 times slower, 20
    // times with textures. Unrolled by us, two slots gain nothing there, and pipelines take longer. On a GPU other
    // subgroups hide the latency.
    const bool isWaiting = workload == Workload::Triangles && device.isSoftware();
    if (config.slotsPerInvocation == 0)
        config.slotsPerInvocation = isWaiting && config.kernel.empty() ? 2 : 1;
    if (config.traversal == Traversal::Automatic) {
        const bool canSkip = config.kernel.empty() && lackFor(Traversal::SkipList, device).empty();
        const bool canStack = lackFor(Traversal::Stack, device).empty();
        config.traversal =
            canSkip && (device.isSoftware() || !canStack) ? Traversal::SkipList : Traversal::Stack;
    }
    // Samples in flight need sums across lanes, which only the kernels over texel buffers have.
    const int lanes = static_cast<int>(std::bit_floor(std::clamp(device.consecutiveLanes, 1u, 8u)));
    if (config.samplesInFlight == 0)
        config.samplesInFlight = lanes;
    config.samplesInFlight =
        config.traversal == Traversal::SkipList ? std::min(config.samplesInFlight, lanes) : 1;
    if (config.steps == 0)
        config.steps = 4096;
    // lavapipe silently stops a subgroup after 65,535 loop iterations of all its lanes together. Kernels count for each
    // lane, and the iterations of diverging lanes add up.
    if (device.isLavapipe())
        config.steps = std::min(config.steps, 65535u / (std::max(device.subgroupSize, 1u) + 1u));
    return config;
}

std::span<const std::uint32_t> kernelWords(const RenderConfig &config, Integrator integrator) {
    if (!config.kernel.empty())
        return config.kernel;
    const std::string name = fmt::format("{}{}{}", rowOf(integrator).kernel,
                                         config.traversal == Traversal::SkipList ? "Skip" : "Stack",
                                         config.slotsPerInvocation == 2 ? "TwoSlots" : "OneSlot");
    return embeddedKernel(name);
}

std::uint64_t hashOfKernels() {
    std::uint64_t hash = 0;
    for (const EmbeddedKernel &kernel : embeddedKernels())
        hash = hashBytes(std::as_bytes(std::span(&kernel.hash, 1)), hash);
    return hash;
}

std::string_view kernelName(const KernelChoice &choice) {
    for (const auto &[name, known] : kernelNames)
        if (known.traversal == choice.traversal && known.slotsPerInvocation == choice.slotsPerInvocation)
            return name;
    return "auto";
}

std::string_view kernelName(const RenderConfig &config) {
    return kernelName(KernelChoice{config.traversal, config.slotsPerInvocation});
}

} // namespace hyalite::core::gpu
