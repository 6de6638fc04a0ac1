// The needs of kernels: of some limits, Vulkan guarantees less.
#pragma once

#include "host/gpu/kernels.h"

#include <string>

namespace hyalite::core::gpu {

/// What keeps the device from running a kernel: a limit, a feature, or a fault of its driver; empty if nothing.
[[nodiscard]] std::string lackFor(const KernelRow &kernel, const DeviceInfo &device);

/// Whether the texel buffers of a scene, as this kernel reads it, fit the device.
[[nodiscard]] bool areTexelsAllowed(const PackedScene &scene, const KernelRow &kernel,
                                    const DeviceInfo &device);

} // namespace hyalite::core::gpu
