// Accounting of device memory in use.
#pragma once

#include <cstdint>
#include <utility>

namespace hyalite::core::gpu {

/// Adds the bytes of an allocation to a total during its lifetime. The total must outlive it.
class MemoryClaim {
  public:
    MemoryClaim() = default;
    MemoryClaim(std::uint64_t &totalBytes, std::uint64_t sizeBytes)
        : totalBytes_(&totalBytes), sizeBytes_(sizeBytes) {
        totalBytes += sizeBytes;
    }
    MemoryClaim(MemoryClaim &&other) noexcept
        : totalBytes_(std::exchange(other.totalBytes_, nullptr)), sizeBytes_(other.sizeBytes_) {}
    MemoryClaim &operator=(MemoryClaim &&other) noexcept {
        std::swap(totalBytes_, other.totalBytes_);
        std::swap(sizeBytes_, other.sizeBytes_);
        return *this;
    }
    ~MemoryClaim() {
        if (totalBytes_ != nullptr)
            *totalBytes_ -= sizeBytes_;
    }

  private:
    std::uint64_t *totalBytes_ = nullptr;
    std::uint64_t sizeBytes_ = 0;
};

} // namespace hyalite::core::gpu
