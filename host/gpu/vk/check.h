// Vulkan results as errors, in release builds too.
#pragma once

#include "host/base/error.h"

#include <vulkan/vulkan.h>

#include <string>

namespace hyalite::core::gpu {

/// "VK_ERROR_DEVICE_LOST" and so on; a number for results that this build does not know.
[[nodiscard]] std::string resultName(VkResult result);

/// A failed Vulkan call. Its work is lost, but may succeed with another device, or with less work at a time.
class DeviceFault : public Error {
  public:
    using Error::Error;
};

/// Throws unless `result` is VK_SUCCESS: DeviceFault{DeviceLost} for a lost device and for time-outs,
/// DeviceFault{LimitExceeded} if memory or address space ran out, DeviceFault{NoDevice} otherwise. `action` says
/// what was tried: "vkAllocateMemory for nodes, 64 MiB".
void check(VkResult result, const std::string &action);

} // namespace hyalite::core::gpu
