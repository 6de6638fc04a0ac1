// Buffers in device memory, filled and read by the host.
#pragma once

#include "host/gpu/buffer_plan.h"
#include "host/gpu/memory_claim.h"
#include "host/gpu/vk/device.h"

#include <cstddef>
#include <span>
#include <string>

namespace hyalite::gpu {

/// A buffer with memory of its own. Where the host cannot see the memory, transfers go through a staging buffer.
class Buffer {
  public:
    /// `name` is for messages. Buffers of 0 bytes get 16, as a binding needs some memory. The contents are
    /// undefined. Throws Error{LimitExceeded} where a limit of the device or its memory does not suffice.
    Buffer(Device &device, std::string name, BufferUse use, std::size_t sizeBytes);
    Buffer(Device &device, const BufferPlan &plan);

    [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
    /// Of all texels; only for BufferUse::Texels.
    [[nodiscard]] VkBufferView view() const { return view_.get(); }
    [[nodiscard]] BufferUse use() const { return use_; }
    [[nodiscard]] std::size_t sizeBytes() const { return sizeBytes_; }

    /// Copies to the beginning of the buffer. All work on the device is finished, and so is the copy on return.
    void upload(std::span<const std::byte> bytes);
    /// Copies from the beginning of the buffer. All work on the device is finished.
    void download(std::span<std::byte> bytes) const;
    /// Sets all bytes to 0, by the device.
    void clear();

  private:
    Device *device_;
    std::string name_;
    BufferUse use_;
    std::size_t sizeBytes_;
    MemoryHandle memory_; ///< before the buffer, to outlive it
    MemoryClaim claim_;
    BufferHandle buffer_;
    BufferViewHandle view_;       ///< after the buffer, to be gone before it
    std::byte *mapped_ = nullptr; ///< null where the host cannot see the memory
};

} // namespace hyalite::gpu
