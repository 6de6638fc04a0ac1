#include "host/gpu/vk/ray_query.h"

#include "host/gpu/vk/extension_functions.h"
#include "host/gpu/vk/physical_device.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace hyalite::core::gpu {

namespace {

/// The largest that a device may ask for (Vulkan, table "Required Limits").
constexpr VkDeviceSize scratchAlignment = 256;

static_assert(sizeof(Box) == sizeof(VkAabbPositionsKHR) &&
              offsetof(Box, upper) == offsetof(VkAabbPositionsKHR, maxX));

/// Makes what was written in one way readable in another.
void wait(VkCommandBuffer commands, VkPipelineStageFlags writer, VkAccessFlags written,
          VkPipelineStageFlags reader, VkAccessFlags read) {
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = written;
    barrier.dstAccessMask = read;
    vkCmdPipelineBarrier(commands, writer, reader, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

VkAccelerationStructureGeometryKHR geometryOf(VkGeometryTypeKHR type, VkDeviceAddress data) {
    VkAccelerationStructureGeometryKHR geometry{};
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = type;
    if (type == VK_GEOMETRY_TYPE_AABBS_KHR) {
        geometry.geometry.aabbs.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR;
        geometry.geometry.aabbs.data.deviceAddress = data;
        geometry.geometry.aabbs.stride = sizeof(Box);
    } else {
        geometry.geometry.instances.sType =
            VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
        geometry.geometry.instances.data.deviceAddress = data;
    }
    return geometry;
}

/// Builds a level of `counts` boxes or instances, whose bytes are `input`.
Buffer build(Device &device, BufferUse level, const std::string &name, std::span<const std::byte> bytes,
             std::span<const std::uint32_t> counts) {
    Buffer input(device, "the input of " + name, BufferUse::BuildInput, bytes.size());
    input.upload(bytes);
    const bool isBottom = level == BufferUse::BottomLevel;
    const std::vector<VkAccelerationStructureGeometryKHR> geometries(
        counts.size(),
        geometryOf(isBottom ? VK_GEOMETRY_TYPE_AABBS_KHR : VK_GEOMETRY_TYPE_INSTANCES_KHR, input.address()));
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
    std::uint32_t first = 0;
    for (const std::uint32_t count : counts) {
        ranges.push_back({count, first * std::uint32_t{sizeof(Box)}, 0, 0});
        first += count;
    }
    VkAccelerationStructureBuildGeometryInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
    info.type = isBottom ? VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR
                         : VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
    info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = static_cast<std::uint32_t>(geometries.size());
    info.pGeometries = geometries.data();
    VkAccelerationStructureBuildSizesInfoKHR sizes{};
    sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
    HYALITE_EXTENSION_FUNCTION(device.get(), vkGetAccelerationStructureBuildSizesKHR)
    (device.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, counts.data(), &sizes);
    Buffer tree(device, name, level, sizes.accelerationStructureSize);
    const Buffer scratch(device, "the scratch memory of " + name, BufferUse::BuildInput,
                         sizes.buildScratchSize + scratchAlignment);
    info.dstAccelerationStructure = tree.structure();
    info.scratchData.deviceAddress =
        (scratch.address() + scratchAlignment - 1) / scratchAlignment * scratchAlignment;
    device.submit("the build of " + name, [&](VkCommandBuffer commands) {
        wait(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
             VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR, VK_ACCESS_SHADER_READ_BIT);
        const VkAccelerationStructureBuildRangeInfoKHR *all = ranges.data();
        HYALITE_EXTENSION_FUNCTION(device.get(), vkCmdBuildAccelerationStructuresKHR)
        (commands, 1, &info, &all);
        wait(commands, VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
             VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR,
             VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
             VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR);
    });
    return tree;
}

} // namespace

RayQueryFeatures::RayQueryFeatures(VkBool32 areWanted) {
    queries.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
    queries.pNext = &structures;
    queries.rayQuery = areWanted;
    structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    structures.pNext = &addresses;
    structures.accelerationStructure = areWanted;
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    addresses.bufferDeviceAddress = areWanted;
}

bool RayQueryFeatures::areAll() const {
    return queries.rayQuery == VK_TRUE && structures.accelerationStructure == VK_TRUE &&
           addresses.bufferDeviceAddress == VK_TRUE;
}

std::uint64_t countQueryBoxes(VkPhysicalDevice device) {
    if (!std::ranges::all_of(rayQueryExtensions,
                             [&](const char *name) { return hasExtension(device, name); }))
        return 0;
    RayQueryFeatures features(VK_FALSE);
    VkPhysicalDeviceFeatures2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    all.pNext = &features.queries;
    vkGetPhysicalDeviceFeatures2(device, &all);
    VkPhysicalDeviceAccelerationStructurePropertiesKHR structures{};
    structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &structures;
    vkGetPhysicalDeviceProperties2(device, &properties);
    const std::uint64_t maxOffset = std::numeric_limits<std::uint32_t>::max(); // of boxes in their buffer
    return features.areAll() ? std::min<std::uint64_t>(structures.maxPrimitiveCount, maxOffset / sizeof(Box))
                             : 0;
}

QueryTree buildQueryTree(Device &device, std::span<const Box> boxes, std::span<const std::uint32_t> counts) {
    Buffer bottom =
        build(device, BufferUse::BottomLevel, "the boxes of ray queries", std::as_bytes(boxes), counts);
    VkAccelerationStructureDeviceAddressInfoKHR address{};
    address.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
    address.accelerationStructure = bottom.structure();
    VkAccelerationStructureInstanceKHR instance{};
    for (int axis = 0; axis < 3; ++axis)
        instance.transform.matrix[axis][axis] = 1.0f;
    instance.mask = 0xFF;
    instance.accelerationStructureReference = HYALITE_EXTENSION_FUNCTION(
        device.get(), vkGetAccelerationStructureDeviceAddressKHR)(device.get(), &address);
    constexpr std::array<std::uint32_t, 1> once{1};
    Buffer top = build(device, BufferUse::TopLevel, "the top level of ray queries",
                       std::as_bytes(std::span(&instance, 1)), once);
    return {std::move(bottom), std::move(top)};
}

} // namespace hyalite::core::gpu
