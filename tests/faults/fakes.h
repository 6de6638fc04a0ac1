// Devices that can do less than the one that there is.
#pragma once

#include <vulkan/vulkan.h>

#include <vector>

namespace hyalite::faults {

// Words of HYALITE_FAKES:
//
//   discrete         a discrete GPU: bulk data is staged, and the kernel for hardware runs
//   small-buffers    1 MiB in a storage buffer, 65,536 texels in a texel buffer
//   small-heap       heaps of 256 MiB
//   tiny-heap        heaps of 1 MiB
//   workgroup-128    workgroups of 128 invocations at most
//   no-timestamps    queues without timestamps
//   no-subgroups     subgroups without any operation
//   no-float-controls  neither rounding to nearest even nor signed zeros promised
//   calibrated       VK_EXT_calibrated_timestamps, where the device lacks it
void fakeProperties(VkPhysicalDeviceProperties &properties);
/// Of the structures in the chain of vkGetPhysicalDeviceProperties2.
void fakeChain(void *next);
void fakeMemory(VkPhysicalDeviceMemoryProperties &memory);
void fakeQueueFamily(VkQueueFamilyProperties &family);
void fakeExtensions(std::vector<VkExtensionProperties> &extensions);

} // namespace hyalite::faults
