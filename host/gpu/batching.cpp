#include "host/gpu/batching.h"

#include "host/base/hash.h"

#include "shaders/embedded_kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string>

namespace hyalite::gpu {

Workload workloadOf(const PackedScene &scene, Integrator integrator) {
    if (integrator == Integrator::Path &&
        (scene.scattering != 0 || (scene.lighting & layout::lightsByEnvironment) != 0))
        return Workload::Shading;
    return scene.hasTriangles ? Workload::Triangles : Workload::Spheres;
}

Batching completed(Batching batching, const DeviceInfo &device, Workload workload) {
    // A software device has few cores; a GPU wants to be filled.
    const int side = device.isSoftware() ? 256 : 512;
    if (batching.tileWidth == 0)
        batching.tileWidth = side;
    if (batching.tileHeight == 0)
        batching.tileHeight = side;
    // Two independent rays at once hide on a CPU how long it waits for nodes of the tree; where there is none, they are
    // only more code. Where shading searches, lavapipe does not unroll the loop over slots around it, and keeps slots in
    // memory: 6 times slower, 20 with textures; unrolled by us they gain nothing there, and pipelines take longer. On a
    // GPU other subgroups hide it.
    const bool isWaiting = workload == Workload::Triangles && device.isSoftware();
    if (batching.slotsPerInvocation == 0)
        batching.slotsPerInvocation = isWaiting && batching.kernel.empty() ? 2 : 1;
    // lavapipe stops a subgroup in silence after 65,535 loop iterations of all of its lanes together. The lanes count
    // for themselves, and lanes that diverge add up.
    const std::uint32_t limit = 65535u / (std::max(device.subgroupSize, 1u) + 1u);
    if (batching.traversal == Traversal::Automatic)
        batching.traversal =
            device.isSoftware() && batching.kernel.empty() ? Traversal::SkipList : Traversal::Stack;
    // Sums over samples abreast cross lanes, which only the kernels over texel buffers do.
    const int lanes = static_cast<int>(std::bit_floor(std::clamp(device.subgroupSize, 1u, 8u)));
    if (batching.samplesAbreast == 0)
        batching.samplesAbreast = lanes;
    batching.samplesAbreast =
        batching.traversal == Traversal::SkipList ? std::min(batching.samplesAbreast, lanes) : 1;
    if (batching.steps == 0)
        batching.steps = device.isSoftware() ? limit : 4096;
    if (device.isSoftware())
        batching.steps = std::min(batching.steps, limit);
    return batching;
}

std::span<const std::uint32_t> kernelWords(const Batching &batching, Integrator integrator) {
    if (!batching.kernel.empty())
        return batching.kernel;
    const bool isView = !isWhitted(integrator) && integrator != Integrator::Path;
    const std::string name =
        fmt::format("{}{}{}", isView ? "view" : (isWhitted(integrator) ? "whitted" : "path"),
                    batching.traversal == Traversal::SkipList ? "Skip" : "Stack",
                    batching.slotsPerInvocation == 2 ? "TwoSlots" : "OneSlot");
    return embeddedKernel(name);
}

std::uint64_t hashOfKernels() {
    std::uint64_t hash = 0;
    for (const EmbeddedKernel &kernel : embeddedKernels())
        hash = hashBytes(std::as_bytes(kernel.words), hash);
    return hash;
}

std::string_view kernelName(const KernelChoice &choice) {
    for (const auto &[name, known] : kernelNames)
        if (known.traversal == choice.traversal && known.slotsPerInvocation == choice.slotsPerInvocation)
            return name;
    return "auto";
}

std::string_view kernelName(const Batching &batching) {
    return kernelName(KernelChoice{batching.traversal, batching.slotsPerInvocation});
}

} // namespace hyalite::gpu
