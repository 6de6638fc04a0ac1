#include "host/gpu/vk/physical_device.h"

#include "host/gpu/arithmetic.h"
#include "host/gpu/kernel_needs.h"
#include "host/gpu/vk/check.h"
#include "host/gpu/vk/ray_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace hyalite::core::gpu {

namespace {

std::string versionText(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

DeviceType deviceType(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return DeviceType::Discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return DeviceType::Integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return DeviceType::Virtual;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return DeviceType::Cpu;
    default:
        return DeviceType::Other;
    }
}

std::string findRejection(VkPhysicalDevice device, const VkPhysicalDeviceProperties &properties) {
    if (properties.apiVersion < VK_API_VERSION_1_1)
        return fmt::format("offers Vulkan {}, 1.1 is needed", versionText(properties.apiVersion));
    if (findComputeQueueFamily(device) == VK_QUEUE_FAMILY_IGNORED)
        return "has no compute queue";
    return {};
}

std::uint64_t largestDeviceHeapBytes(VkPhysicalDevice device) {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    std::uint64_t bytes = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            bytes = std::max<std::uint64_t>(bytes, memory.memoryHeaps[i].size);
    return bytes;
}

/// Subgroups, driver, float controls and the largest allocation, which Vulkan 1.0 does not tell.
void describeByProperties2(VkPhysicalDevice device, std::uint32_t apiVersion, DeviceInfo &info) {
    // The chain must not contain structures of unsupported extensions.
    VkPhysicalDeviceSubgroupProperties subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceFloatControlsProperties floats{};
    floats.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES;
    const bool is12 = apiVersion >= VK_API_VERSION_1_2;
    const bool hasDriver = is12 || hasExtension(device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME);
    // We use Vulkan 1.1, in which float controls are an extension, even if the device supports later versions.
    const bool hasFloats = hasExtension(device, VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME);
    VkPhysicalDeviceMaintenance3Properties allocations{};
    allocations.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    void *next = &allocations;
    if (hasFloats) {
        floats.pNext = next;
        next = &floats;
    }
    if (hasDriver) {
        driver.pNext = next;
        next = &driver;
    }
    subgroup.pNext = next;
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    all.pNext = &subgroup;
    vkGetPhysicalDeviceProperties2(device, &all);
    info.subgroupSize = subgroup.subgroupSize;
    constexpr VkSubgroupFeatureFlags operations =
        VK_SUBGROUP_FEATURE_SHUFFLE_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
    info.canShuffle = (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 &&
                      (subgroup.supportedOperations & operations) == operations;
    info.maxAllocationBytes = allocations.maxMemoryAllocationSize;
    info.maxQueryBoxes = countQueryBoxes(device);
    const auto canRun = [&](const KernelRow &kernel) { return lackFor(kernel, info).empty(); };
    if (info.isUsable() && std::ranges::none_of(kernelTable, canRun))
        info.rejection = lackFor(kernelTable.front(), info);
    if (hasDriver) {
        const std::string_view details = driver.driverInfo; // SwiftShader has none
        info.driver = fmt::format("{}{}{}", driver.driverName, details.empty() ? "" : " ", details);
        info.driverId = static_cast<std::uint32_t>(driver.driverID);
        info.hasExactDivisionListed = isExactDivisionListed(info.driverId);
    }
    if (hasFloats) {
        info.canRoundToNearestEven = floats.shaderRoundingModeRTEFloat32 == VK_TRUE;
        info.canPreserveSignedZeroInfNan = floats.shaderSignedZeroInfNanPreserveFloat32 == VK_TRUE;
    }
}

} // namespace

bool hasExtension(VkPhysicalDevice device, const char *name) {
    const std::string action = fmt::format("vkEnumerateDeviceExtensionProperties for {}", name);
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), action);
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()), action);
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties &extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

std::vector<VkQueueFamilyProperties> queueFamiliesOf(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    return families;
}

std::uint32_t findComputeQueueFamily(VkPhysicalDevice device) {
    const std::vector<VkQueueFamilyProperties> families = queueFamiliesOf(device);
    for (std::uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0 && families[i].queueCount > 0)
            return i;
    return VK_QUEUE_FAMILY_IGNORED;
}

DeviceInfo describePhysicalDevice(VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    DeviceInfo info;
    info.name = properties.deviceName;
    info.type = deviceType(properties.deviceType);
    info.apiVersion = versionText(properties.apiVersion);
    info.driver = fmt::format("driver {:#x}", properties.driverVersion);
    info.vendorId = properties.vendorID;
    info.deviceId = properties.deviceID;
    info.maxWorkgroupInvocations = properties.limits.maxComputeWorkGroupInvocations;
    info.maxWorkgroupCount = properties.limits.maxComputeWorkGroupCount[0];
    info.maxStorageBufferBytes = properties.limits.maxStorageBufferRange;
    info.maxTexelBufferElements = properties.limits.maxTexelBufferElements;
    info.maxStorageBuffersPerStage = properties.limits.maxPerStageDescriptorStorageBuffers;
    info.maxStorageImagesPerStage = properties.limits.maxPerStageDescriptorStorageImages;
    info.deviceMemoryBytes = largestDeviceHeapBytes(device);
    info.rejection = findRejection(device, properties);
    const std::uint32_t family = findComputeQueueFamily(device);
    info.hasTimestamps =
        family != VK_QUEUE_FAMILY_IGNORED && queueFamiliesOf(device)[family].timestampValidBits > 0;
    info.isPortabilitySubset = hasExtension(device, portabilitySubset);
    info.hasCalibratedTimestamps = hasExtension(device, VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME);
    if (properties.apiVersion >= VK_API_VERSION_1_1)
        describeByProperties2(device, properties.apiVersion, info);
    return info;
}

} // namespace hyalite::core::gpu
