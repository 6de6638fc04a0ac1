// Comparison of a buffer's words with what they should be, on the device: only what differs comes back.
#pragma once

#include "host/gpu/kernel.h"
#include "host/gpu/vk/buffer.h"
#include "shaders/layout/exercise_records.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hyalite::core::gpu {

/// What a comparison found.
struct WordDifferences {
    std::uint32_t count = 0;
    /// At most layout::maxWrongWords of them, in any order.
    std::vector<layout::WrongWord> words{};
};

/// A buffer of the device with the words that others should have.
class ExpectedWords {
  public:
    /// At least one word. Throws as Buffer and Pipeline do.
    ExpectedWords(Device &device, std::span<const std::uint32_t> words);

    /// Compares the first `wordCount` words of a buffer of storage; word i should be word (i + offset) % n of these n,
    /// each with `mask` XORed to it. wordCount + offset < 2^32. Throws DeviceFault.
    [[nodiscard]] WordDifferences compare(const Buffer &buffer, std::uint32_t wordCount,
                                          std::uint32_t offset = 0, std::uint32_t mask = 0);

    /// Replaces the words by as many others.
    void replace(std::span<const std::uint32_t> words) { expected_.upload(std::as_bytes(words)); }

  private:
    Device &device_;
    std::uint32_t period_;
    Buffer expected_;
    Buffer task_;
    std::shared_ptr<Pipeline> pipeline_;
};

/// Workgroups of 64 invocations, of which each does several of `count` items.
[[nodiscard]] std::uint32_t wordGroups(std::uint32_t count, const DeviceInfo &device);

} // namespace hyalite::core::gpu
