// Vulkan results as errors: checked in release builds too.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace hyalite::gpu {

/// "VK_ERROR_DEVICE_LOST" and so on; a number for results that this build does not know.
[[nodiscard]] std::string resultName(VkResult result);

/// Throws unless `result` is VK_SUCCESS: Error{DeviceLost} for a lost device and for time-outs, Error{LimitExceeded}
/// where memory or address space ran out, Error{NoDevice} otherwise. `action` says what was tried: "vkAllocateMemory for nodes, 64 MiB".
void check(VkResult result, const std::string &action);

} // namespace hyalite::gpu
