#include "tests/faults/fakes.h"

#include "tests/faults/plan.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace hyalite::faults {

void fakeProperties(VkPhysicalDeviceProperties &properties) {
    VkPhysicalDeviceLimits &limits = properties.limits;
    if (plan().isFaked("discrete"))
        properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    if (plan().isFaked("small-buffers")) {
        limits.maxStorageBufferRange = 1u << 20;
        limits.maxTexelBufferElements = 1u << 16;
    }
    if (plan().isFaked("workgroup-128")) {
        limits.maxComputeWorkGroupInvocations = 128;
        for (std::uint32_t &size : limits.maxComputeWorkGroupSize)
            size = std::min(size, 128u);
    }
    if (plan().isFaked("no-timestamps"))
        limits.timestampComputeAndGraphics = VK_FALSE;
    if (plan().isFaked("few-images"))
        limits.maxPerStageDescriptorStorageImages = 4;
    if (plan().isFaked("few-storage-buffers"))
        limits.maxPerStageDescriptorStorageBuffers = 8;
    if (plan().isFaked("few-texels"))
        limits.maxTexelBufferElements = 64;
    if (plan().isFaked("vulkan-1.0"))
        properties.apiVersion = VK_API_VERSION_1_0;
}

void fakeChain(void *next) {
    for (auto *part = static_cast<VkBaseOutStructure *>(next); part != nullptr; part = part->pNext) {
        if (part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES &&
            plan().isFaked("no-subgroups")) {
            auto &subgroup = reinterpret_cast<VkPhysicalDeviceSubgroupProperties &>(*part);
            subgroup.supportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
        }
        if (part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES &&
            plan().isFaked("small-allocations"))
            reinterpret_cast<VkPhysicalDeviceMaintenance3Properties &>(*part).maxMemoryAllocationSize = 1u
                                                                                                        << 20;
        if (part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES &&
            plan().isFaked("other-driver")) {
            auto &driver = reinterpret_cast<VkPhysicalDeviceDriverProperties &>(*part);
            driver.driverID = VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
            std::strcpy(driver.driverName, "another driver");
        }
        if (part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES &&
            plan().isFaked("no-float-controls")) {
            auto &floats = reinterpret_cast<VkPhysicalDeviceFloatControlsProperties &>(*part);
            floats.shaderRoundingModeRTEFloat32 = VK_FALSE;
            floats.shaderSignedZeroInfNanPreserveFloat32 = VK_FALSE;
        }
    }
}

void fakeMemory(VkPhysicalDeviceMemoryProperties &memory) {
    for (const auto &[fake, maxBytes] : {std::pair{"small-heap", 256u << 20}, {"tiny-heap", 1u << 20}})
        if (plan().isFaked(fake))
            for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
                memory.memoryHeaps[i].size = std::min<VkDeviceSize>(memory.memoryHeaps[i].size, maxBytes);
}

void fakeQueueFamily(VkQueueFamilyProperties &family) {
    if (plan().isFaked("no-timestamps"))
        family.timestampValidBits = 0;
}

void fakeArithmetic(std::vector<std::uint32_t> &words) {
    constexpr std::uint32_t constant = 4u << 16 | 43; // OpConstant of one word
    constexpr std::uint32_t inversePi = 0x3EA2F983;
    if (!plan().isFaked("other-pi"))
        return;
    for (std::size_t i = 5; i < words.size() && words[i] >> 16 > 0; i += words[i] >> 16)
        if (words[i] == constant && words[i + 3] == inversePi)
            ++words[i + 3];
}

void fakeExtensions(std::vector<VkExtensionProperties> &extensions) {
    const auto has = [&](const char *name) {
        return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties &extension) {
            return std::strcmp(extension.extensionName, name) == 0;
        });
    };
    for (const auto &[fake, name] : {std::pair{"calibrated", VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME},
                                     {"portability", "VK_KHR_portability_subset"}}) {
        if (!plan().isFaked(fake) || has(name))
            continue;
        VkExtensionProperties extension{};
        std::strcpy(extension.extensionName, name);
        extension.specVersion = 1;
        extensions.push_back(extension);
    }
}

} // namespace hyalite::faults
