// Render configuration: which kernel runs, and how its work is divided into dispatches.
#pragma once

#include "host/gpu/arithmetic.h"
#include "host/gpu/kernels.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace hyalite::core::gpu {

/// How the work of a render is divided and done. No member affects the image.
struct RenderConfig {
    int tileWidth = 0;            ///< pixels, a multiple of 8; 0: by the device
    int tileHeight = 0;           ///< pixels, a multiple of 8; 0: by the device
    std::uint32_t steps = 0;      ///< loop iterations of a path slot in one dispatch; 0: by the device
    double dispatchSeconds = 0.1; ///< wanted time of a dispatch; > 0
    int samplesInFlight = 0;      ///< slots of one pixel: 1, 2, 4 or 8; 0: by the device and the sample count
    bool isStaged = false;        ///< transfer everything through staging buffers
    bool isCounting = false;      ///< count the work of the traversal
    Arithmetic arithmetic = Arithmetic::Automatic; ///< division and square root
    const KernelRow *kernel = nullptr;             ///< null: by device and scene
    /// SPIR-V instead of that of `kernel`, which is named then: for tests of how a faulty one is found.
    std::span<const std::uint32_t> spirv{};
};

/// Fills in every member of `config` that was left to the device.
[[nodiscard]] RenderConfig completed(RenderConfig config, const DeviceInfo &device,
                                     Workload workload = Workload::Triangles);

/// SPIR-V of the kernel for `integrator` and a complete `config`.
[[nodiscard]] std::span<const std::uint32_t> kernelWords(const RenderConfig &config, Integrator integrator);

/// Hash of all kernels: measurements of other kernels do not count.
[[nodiscard]] std::uint64_t hashOfKernels();

/// The preferred kernel for each Workload; null: none.
using KernelChoices = std::array<const KernelRow *, workloadNames.size()>;

/// The word for the kernel of `config`.
[[nodiscard]] inline std::string_view kernelName(const RenderConfig &config) {
    return kernelName(config.kernel);
}

} // namespace hyalite::core::gpu
