// Capabilities of a physical device, and whether they suffice.
#pragma once

#include "host/gpu/vk/device_list.h"

#include <vulkan/vulkan.h>

namespace hyalite::gpu {

/// Everything except the index.
[[nodiscard]] DeviceInfo describePhysicalDevice(VkPhysicalDevice device);

/// The first queue family that can compute, or VK_QUEUE_FAMILY_IGNORED.
[[nodiscard]] std::uint32_t findComputeQueueFamily(VkPhysicalDevice device);

} // namespace hyalite::gpu
