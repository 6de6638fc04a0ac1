// Devices that can do less than the one that there is.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
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
//   few-images       4 storage images a stage, the minimum that Vulkan guarantees
//   few-storage-buffers  8 storage buffers a stage
//   few-texels       64 texels in a texel buffer
//   small-allocations  pieces of memory of at most 1 MiB
//   vulkan-1.0       a device of Vulkan 1.0
//   other-driver     a driver that nothing is known of
//   portability      a device with VK_KHR_portability_subset
//   other-pi         kernels compute with another float near 1 / pi, as a driver with a fault of its own would
//   calibrated       VK_EXT_calibrated_timestamps, where the device lacks it
void fakeProperties(VkPhysicalDeviceProperties &properties);
/// Of the structures in the chain of vkGetPhysicalDeviceProperties2.
void fakeChain(void *next);
void fakeMemory(VkPhysicalDeviceMemoryProperties &memory);
void fakeQueueFamily(VkQueueFamilyProperties &family);
/// Of SPIR-V.
void fakeArithmetic(std::vector<std::uint32_t> &words);
void fakeExtensions(std::vector<VkExtensionProperties> &extensions);

} // namespace hyalite::faults
