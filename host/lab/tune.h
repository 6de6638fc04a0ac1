// Kernel tuning: measures which kernels are fastest on a device.
#pragma once

#include "host/engine/tuning.h"

#include <nlohmann/json.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace hyalite::core {

/// Measured rates of the kernels for one kind of scene.
struct KernelRates {
    gpu::Workload workload = gpu::Workload::Spheres;
    std::string scene;                     ///< name of a shipped scene
    std::vector<double> megaraysPerSecond; ///< best rate of each of gpu::kernelTable
    /// Index of the fastest kernel; the default one unless another is always 5 % faster.
    std::size_t best = 0;
};

/// Runs work in a process of its own, and returns its result or throws its Error: inOwnProcess() of
/// host/process/apart.h.
using RunApart = std::function<nlohmann::json(const std::function<nlohmann::json()> &work)>;

/// Renders small images of shipped scenes with each kernel, in several rounds, and verifies that all images are equal.
/// Takes half a minute. The program must not have opened a device before: each kind of scene is measured in a process
/// of its own, because the vector width of lavapipe can be set only once per process. Throws what opening and rendering
/// throw, and Error{DeviceLost} if the images differ.
[[nodiscard]] std::vector<KernelRates> measureKernels(const std::string &deviceName, Observer &observer,
                                                      const RunApart &runApart);

} // namespace hyalite::core
