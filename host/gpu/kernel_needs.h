// The needs of kernels: of some limits, Vulkan guarantees less.
#pragma once

#include "host/gpu/kernels.h"

#include <string>

namespace hyalite::core::gpu {

/// The limit or feature that the device lacks for a kernel; empty if none.
[[nodiscard]] std::string lackFor(const KernelRow &kernel, const DeviceInfo &device);

/// Whether the texel buffers of a scene, as this kernel reads it, fit the device.
[[nodiscard]] bool areTexelsAllowed(const PackedScene &scene, const KernelRow &kernel,
                                    const DeviceInfo &device);

} // namespace hyalite::core::gpu
