// Vulkan buffers in device memory, written and read by the host.
#pragma once

#include "host/gpu/buffer_plan.h"
#include "host/gpu/memory_claim.h"
#include "host/gpu/vk/device.h"

#include <cstddef>
#include <span>
#include <string>

namespace hyalite::core::gpu {

/// A buffer with memory of its own. If the host cannot map it, transfers go through a staging buffer.
class Buffer {
  public:
    /// `name` is for messages. Buffers of 0 bytes get 16, because Vulkan has no empty buffers. The contents are
    /// undefined. Throws Error{LimitExceeded} if a device limit or its memory is too small.
    Buffer(Device &device, std::string name, BufferUse use, std::size_t sizeBytes);
    Buffer(Device &device, const BufferPlan &plan);

    [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
    /// A view of all texels; only for BufferUse::Texels.
    [[nodiscard]] VkBufferView view() const { return view_.get(); }
    /// Only for BufferUse::BottomLevel and BufferUse::TopLevel.
    [[nodiscard]] VkAccelerationStructureKHR structure() const { return structure_.get(); }
    /// On the device; only for BufferUse::BuildInput.
    [[nodiscard]] VkDeviceAddress address() const;
    [[nodiscard]] BufferUse use() const { return use_; }
    [[nodiscard]] std::size_t sizeBytes() const { return sizeBytes_; }

    /// Copies to the buffer, from `offset` on. All work on the device is finished, and so is the copy on return.
    void upload(std::span<const std::byte> bytes, std::size_t offset = 0);
    /// Copies from the beginning of the buffer. All work on the device is finished.
    void download(std::span<std::byte> bytes) const;
    /// Sets all bytes to 0, by the device.
    void clear();

  private:
    Device *device_;
    std::string name_;
    BufferUse use_;
    std::size_t sizeBytes_;
    MemoryHandle memory_; ///< declared before the buffer: it is destroyed after it
    MemoryClaim claim_;
    BufferHandle buffer_;
    BufferViewHandle view_;                 ///< declared after the buffer: it is destroyed before it
    AccelerationStructureHandle structure_; ///< likewise
    std::byte *mapped_ = nullptr;           ///< null if the host cannot map the memory
};

} // namespace hyalite::core::gpu
