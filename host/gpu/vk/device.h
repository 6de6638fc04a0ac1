// A logical device with one compute queue, and work submitted to it.
#pragma once

#include "host/gpu/vk/debug_utils.h"
#include "host/gpu/vk/device_list.h"
#include "host/gpu/vk/instance.h"
#include "host/gpu/vk/timestamps.h"

#include <cstdint>
#include <functional>
#include <string>

namespace hyalite::core::gpu {

/// Whether bulk data goes through staging buffers. Automatic: on discrete GPUs, whose memory the host reads slowly.
enum class Transfers { Automatic, Staged };

class Device {
  public:
    /// Opens the device that `info` describes. Throws Error{NoDevice} if it is gone or cannot be opened.
    explicit Device(const DeviceInfo &info, Transfers transfers = Transfers::Automatic);

    [[nodiscard]] VkDevice get() const { return device_.get(); }
    [[nodiscard]] const DeviceInfo &info() const { return info_; }
    [[nodiscard]] const Instance &instance() const { return instance_; }

    /// A memory type among `typeBits` that has all `flags`, or VK_MAX_MEMORY_TYPES.
    [[nodiscard]] std::uint32_t findMemoryType(std::uint32_t typeBits, VkMemoryPropertyFlags flags) const;

    /// Whether the host can map memory of this type.
    [[nodiscard]] bool isMappable(std::uint32_t memoryType) const;
    [[nodiscard]] bool isStagingPreferred() const { return isStagingPreferred_; }

    [[nodiscard]] Timestamps &timestamps() { return timestamps_; }
    [[nodiscard]] const DebugUtils &debugUtils() const { return debugUtils_; }
    /// Bytes of all live buffers.
    [[nodiscard]] std::uint64_t &allocatedBytes() { return allocatedBytes_; }

    /// Records commands with `record`, submits them and waits until they are finished. Throws DeviceFault naming
    /// `action` if the device fails or does not finish within two minutes; a software device, which compiles kernels
    /// meanwhile, has twenty. After a time-out the device and its objects
    /// are never destroyed, because they may still be in use.
    void submit(const std::string &action, const std::function<void(VkCommandBuffer)> &record);

  private:
    /// With one queue of the family.
    void createDevice(std::uint32_t queueFamily);
    /// The command buffer, its pool and its fence.
    void createCommands(std::uint32_t queueFamily);
    void waitForFence(const std::string &action);

    DeviceInfo info_;
    bool isStagingPreferred_;
    Instance instance_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties memory_{};
    DeviceHandle device_;
    VkQueue queue_ = VK_NULL_HANDLE;
    CommandPoolHandle commandPool_;
    VkCommandBuffer commandBuffer_ = VK_NULL_HANDLE; ///< freed with its pool
    FenceHandle fence_;
    DebugUtils debugUtils_;
    Timestamps timestamps_;
    std::uint64_t allocatedBytes_ = 0;
};

} // namespace hyalite::core::gpu
