// Timestamps of kernels by the device's clock, on the host's time line.
#pragma once

#include "host/film/timeline.h"
#include "host/gpu/vk/handle.h"

#include <cstdint>
#include <optional>
#include <string>

namespace hyalite::core::gpu {

/// One pair of timestamps, written by the device around a kernel and read after each submission.
class Timestamps {
  public:
    Timestamps() = default;
    /// `isCalibrationEnabled`: VK_EXT_calibrated_timestamps is enabled on the device.
    Timestamps(VkInstance instance, VkPhysicalDevice physical, VkDevice device, std::uint32_t queueFamily,
               bool isCalibrationEnabled);

    /// Both write nothing if the queue has no timestamps.
    void writeBegin(VkCommandBuffer commands) const;
    void writeEnd(VkCommandBuffer commands) const;

    /// The span between the two timestamps, after their submission is finished. `host` is the time from before the
    /// submission until the host knew that it was finished. Empty if the queue has no timestamps.
    [[nodiscard]] std::optional<Span> read(const Span &host);

    /// Description of the clock that times kernels.
    [[nodiscard]] std::string describe() const;

  private:
    /// One moment on both clocks.
    struct Calibration {
        std::uint64_t deviceTicks = 0;
        std::int64_t hostNanos = 0;
    };

    [[nodiscard]] std::int64_t nanosOf(std::uint64_t ticks) const;
    void calibrate();

    VkDevice device_ = VK_NULL_HANDLE;
    QueryPoolHandle queries_;
    std::uint32_t validBits_ = 0; ///< 0: the queue has no timestamps
    float nanosPerTick_ = 0.0f;
    PFN_vkGetCalibratedTimestampsEXT getCalibratedTimestamps_ = nullptr; ///< null without the extension
    std::optional<Calibration> calibration_;
};

} // namespace hyalite::core::gpu
