// Capabilities of a physical device, and whether they suffice.
#pragma once

#include "host/gpu/vk/device_list.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace hyalite::core::gpu {

/// An extension that devices offer which lack a part of Vulkan, and that must then be enabled. Vulkan's headers have
/// its name among those of provisional extensions only.
inline constexpr const char *portabilitySubset = "VK_KHR_portability_subset";

/// Throws if the query fails, because treating the extension as missing would change what is rendered.
[[nodiscard]] bool hasExtension(VkPhysicalDevice device, const char *name);

/// Everything except the index.
[[nodiscard]] DeviceInfo describePhysicalDevice(VkPhysicalDevice device);

[[nodiscard]] std::vector<VkQueueFamilyProperties> queueFamiliesOf(VkPhysicalDevice device);

/// The first queue family that can compute, or VK_QUEUE_FAMILY_IGNORED.
[[nodiscard]] std::uint32_t findComputeQueueFamily(VkPhysicalDevice device);

} // namespace hyalite::core::gpu
