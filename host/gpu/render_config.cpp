#include "host/gpu/render_config.h"

#include "host/base/hash.h"

#include "shaders/embedded_kernels.h"

#include <algorithm>
#include <bit>

namespace hyalite::core::gpu {

RenderConfig completed(RenderConfig config, const DeviceInfo &device, Workload workload) {
    // A software device has few cores; a GPU needs many invocations.
    const int side = device.isSoftware() ? 256 : 512;
    if (config.tileWidth == 0)
        config.tileWidth = side;
    if (config.tileHeight == 0)
        config.tileHeight = side;
    if (config.kernel == nullptr)
        config.kernel = &chooseKernel(device, workload);
    // Samples in flight need sums across lanes.
    const int lanes = static_cast<int>(std::bit_floor(std::clamp(device.consecutiveLanes, 1u, 8u)));
    if (config.samplesInFlight == 0)
        config.samplesInFlight = lanes;
    config.samplesInFlight =
        config.kernel->lanes == KernelLanes::Exchanging ? std::min(config.samplesInFlight, lanes) : 1;
    if (config.steps == 0)
        config.steps = 4096;
    // lavapipe silently stops a subgroup after 65,535 loop iterations of all its lanes together. Kernels count for each
    // lane, and the iterations of diverging lanes add up.
    if (device.isLavapipe())
        config.steps = std::min(config.steps, 65535u / (std::max(device.subgroupSize, 1u) + 1u));
    return config;
}

std::span<const std::uint32_t> kernelWords(const RenderConfig &config, Integrator integrator) {
    return config.spirv.empty() ? embeddedKernel(moduleName(rowOf(integrator).kernel, *config.kernel))
                                : config.spirv;
}

std::uint64_t hashOfKernels() {
    std::uint64_t hash = 0;
    for (const EmbeddedKernel &kernel : embeddedKernels())
        hash = hashBytes(std::as_bytes(std::span(&kernel.hash, 1)), hash);
    return hash;
}

} // namespace hyalite::core::gpu
