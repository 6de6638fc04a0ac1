// What a buffer is for, and how large it will be.
#pragma once

#include "host/gpu/vk/device_list.h"

#include <cstdint>
#include <string>

namespace hyalite::gpu {

enum class BufferUse {
    Uniform,  ///< small constants
    Storage,  ///< the bulk: in device memory, which the host may not see
    Texels,   ///< the same, read by kernels as texels of four 32-bit words
    Counters, ///< storage that the host reads and writes between dispatches: in host memory
    Staging,  ///< a stop-over of transfers, in host memory
};

struct BufferPlan {
    std::string name; ///< for messages: "the triangles"
    BufferUse use = BufferUse::Storage;
    std::uint64_t sizeBytes = 0;
};

/// The bytes that one buffer of a use may have on the device.
[[nodiscard]] std::uint64_t mostBytes(BufferUse use, const DeviceInfo &device);

/// Throws Error{LimitExceeded} where the device allows no buffer of this size.
void requireBuffer(const BufferPlan &plan, const DeviceInfo &device);

} // namespace hyalite::gpu
