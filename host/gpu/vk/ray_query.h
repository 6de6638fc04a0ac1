// Ray queries: what a device must offer for them, and the acceleration structures that they go through.
#pragma once

#include "host/bvh/bvh.h"
#include "host/gpu/vk/buffer.h"

#include <array>
#include <cstdint>
#include <span>

namespace hyalite::core::gpu {

/// What ray queries need beside Vulkan 1.1, those first that few devices have.
inline constexpr std::array rayQueryExtensions{VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                               VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                               VK_KHR_SPIRV_1_4_EXTENSION_NAME,
                                               VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME,
                                               VK_KHR_BUFFER_DEVICE_ADDRESS_EXTENSION_NAME,
                                               VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME,
                                               VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

/// Their features, as a chain of structures.
struct RayQueryFeatures {
    VkPhysicalDeviceRayQueryFeaturesKHR queries{};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{};
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};

    /// Of features that are wanted; or to be filled.
    explicit RayQueryFeatures(VkBool32 areWanted);
    RayQueryFeatures(const RayQueryFeatures &) = delete;
    RayQueryFeatures &operator=(const RayQueryFeatures &) = delete;

    [[nodiscard]] bool areAll() const;
};

/// How many boxes the device allows in a tree for ray queries; 0 if it has none.
[[nodiscard]] std::uint64_t countQueryBoxes(VkPhysicalDevice device);

/// A tree of boxes on the device. The top level has the bottom level once, where it is.
struct QueryTree {
    Buffer bottom;
    Buffer top; ///< to be bound; it refers to the other one
};

/// `counts` has the number of boxes of each geometry; `boxes` are those of all geometries in turn. Throws as `check` does.
[[nodiscard]] QueryTree buildQueryTree(Device &device, std::span<const Box> boxes,
                                       std::span<const std::uint32_t> counts);

} // namespace hyalite::core::gpu
