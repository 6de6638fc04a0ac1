// The use and the size of a buffer.
#pragma once

#include "host/gpu/vk/device_list.h"

#include <cstdint>
#include <string>

namespace hyalite::core::gpu {

enum class BufferUse {
    Uniform,     ///< small constants
    Storage,     ///< bulk data, in device memory that the host may not see
    Texels,      ///< the same, read by kernels as texels of four 32-bit words
    Counters,    ///< storage that the host reads and writes between dispatches: in host memory
    Staging,     ///< staging buffers for transfers, in host memory
    BuildInput,  ///< what acceleration structures are built from, and in
    BottomLevel, ///< an acceleration structure of boxes
    TopLevel,    ///< of bottom levels: it is bound
};

struct BufferPlan {
    std::string name; ///< for messages: "the triangles"
    BufferUse use = BufferUse::Storage;
    std::uint64_t sizeBytes = 0;
};

/// Maximum size of one buffer of this use on the device, in bytes.
[[nodiscard]] std::uint64_t maxBufferBytes(BufferUse use, const DeviceInfo &device);

/// Throws Error{LimitExceeded} if the device does not allow a buffer of this size.
void requireBuffer(const BufferPlan &plan, const DeviceInfo &device);

} // namespace hyalite::core::gpu
