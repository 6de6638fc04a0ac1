// Kernel tuning: measures which kernels are fastest on a device.
#pragma once

#include "host/render/tuning.h"

#include <array>
#include <string>
#include <vector>

namespace hyalite {

/// How fast the kernels are with one kind of scene.
struct KernelRates {
    gpu::Workload workload = gpu::Workload::Spheres;
    std::string scene;                     ///< a shipped one
    std::vector<double> megaraysPerSecond; ///< of each of gpu::namedKernels, at its best
    std::size_t best = 0;                  ///< among them; the usual one, unless another is always 5 % faster
};

/// Renders small images of shipped scenes with all kernels, some times in turns, and verifies that all are equal. It
/// takes half a minute. The program must not have opened a device before: this works in a process of its own for each
/// kind of scene, as the width of lavapipe's vectors can be chosen once. Throws what opening and rendering throw, and
/// Error{DeviceLost} where kernels do not agree.
[[nodiscard]] std::vector<KernelRates> measureKernels(const std::string &deviceName);

} // namespace hyalite
