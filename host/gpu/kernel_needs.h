// The needs of a traversal's kernels: of some limits, Vulkan guarantees less.
#pragma once

#include "host/gpu/render_config.h"

#include <string>

namespace hyalite::core::gpu {

/// The limit or feature that the device lacks for kernels with this traversal, which is not Automatic; empty if none.
[[nodiscard]] std::string lackFor(Traversal traversal, const DeviceInfo &device);

/// Whether the texel buffers of a scene with a skip list fit the device.
[[nodiscard]] bool areTexelsAllowed(const PackedScene &scene, const DeviceInfo &device);

} // namespace hyalite::core::gpu
