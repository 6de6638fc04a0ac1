// What a Vulkan physical device offers, and whether that is enough.
#pragma once

#include "host/gpu/vk/device_list.h"

#include <vulkan/vulkan.h>

namespace hyalite::gpu {

/// All but the index.
[[nodiscard]] DeviceInfo describePhysicalDevice(VkPhysicalDevice device);

/// The first queue family that can compute, or VK_QUEUE_FAMILY_IGNORED.
[[nodiscard]] std::uint32_t findComputeQueueFamily(VkPhysicalDevice device);

} // namespace hyalite::gpu
