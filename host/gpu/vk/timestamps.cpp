#include "host/gpu/vk/timestamps.h"

#include "host/gpu/vk/check.h"
#include "host/gpu/vk/physical_device.h"
#include "host/gpu/vk/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hyalite::core::gpu {

namespace {

// std::chrono::steady_clock is CLOCK_MONOTONIC on the systems that we build for.
constexpr VkTimeDomainEXT hostDomain = VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT;

bool canCalibrate(VkInstance instance, VkPhysicalDevice physical) {
    const auto list = reinterpret_cast<PFN_vkGetPhysicalDeviceCalibrateableTimeDomainsEXT>(
        vkGetInstanceProcAddr(instance, "vkGetPhysicalDeviceCalibrateableTimeDomainsEXT"));
    if (list == nullptr)
        return false;
    std::uint32_t count = 0;
    const char *const action = "vkGetPhysicalDeviceCalibrateableTimeDomainsEXT for timestamps";
    check(list(physical, &count, nullptr), action);
    std::vector<VkTimeDomainEXT> domains(count);
    check(list(physical, &count, domains.data()), action);
    const auto has = [&](VkTimeDomainEXT domain) {
        return std::find(domains.begin(), domains.end(), domain) != domains.end();
    };
    return has(VK_TIME_DOMAIN_DEVICE_EXT) && has(hostDomain);
}

} // namespace

Timestamps::Timestamps(VkInstance instance, VkPhysicalDevice physical, VkDevice device,
                       std::uint32_t queueFamily, bool isCalibrationEnabled)
    : device_(device) {
    validBits_ = std::min(queueFamiliesOf(physical)[queueFamily].timestampValidBits, 64u);
    if (validBits_ == 0)
        return;
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    nanosPerTick_ = properties.limits.timestampPeriod;

    VkQueryPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    create.queryType = VK_QUERY_TYPE_TIMESTAMP;
    create.queryCount = 2;
    VkQueryPool queries = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device, &create, nullptr, &queries), "vkCreateQueryPool for timestamps");
    queries_ = QueryPoolHandle(device, queries);
    if (isCalibrationEnabled && canCalibrate(instance, physical))
        getCalibratedTimestamps_ = reinterpret_cast<PFN_vkGetCalibratedTimestampsEXT>(
            vkGetDeviceProcAddr(device, "vkGetCalibratedTimestampsEXT"));
}

void Timestamps::writeBegin(VkCommandBuffer commands) const {
    if (validBits_ == 0)
        return;
    vkCmdResetQueryPool(commands, queries_.get(), 0, 2);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, queries_.get(), 0);
}

void Timestamps::writeEnd(VkCommandBuffer commands) const {
    if (validBits_ == 0)
        return;
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, queries_.get(), 1);
}

std::optional<Span> Timestamps::read(const Span &host) {
    if (validBits_ == 0)
        return std::nullopt;
    std::array<std::uint64_t, 2> ticks{};
    check(vkGetQueryPoolResults(device_, queries_.get(), 0, 2, sizeof(ticks), ticks.data(), sizeof(ticks[0]),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults for timestamps");
    const std::int64_t hostLength = host.endNanos - host.beginNanos;
    const auto maxTicks =
        static_cast<std::uint64_t>(static_cast<double>(hostLength) / static_cast<double>(nanosPerTick_));
    // Between two dispatches the clock rates hardly differ, and a double holds a length in ticks exactly.
    const std::int64_t length =
        std::min(nanosOf(elapsedTicks(ticks[0], ticks[1], validBits_, maxTicks)), hostLength);

    constexpr std::int64_t freshNanos = 1'000'000'000; // clocks drift apart by microseconds a second
    if (getCalibratedTimestamps_ != nullptr &&
        (!calibration_ || host.endNanos - calibration_->hostNanos > freshNanos))
        calibrate();
    std::int64_t begin = host.beginNanos + (hostLength - length) / 2;
    if (calibration_) {
        const std::int64_t since = signedTicks(calibration_->deviceTicks, ticks[0], validBits_);
        const std::int64_t distance = nanosOf(static_cast<std::uint64_t>(std::abs(since)));
        begin = calibration_->hostNanos + (since < 0 ? -distance : distance);
        // A kernel runs after its submission, and before the host knows of its end.
        begin = std::clamp(begin, host.beginNanos, host.endNanos - length);
    }
    return Span{begin, begin + length};
}

std::string Timestamps::describe() const {
    if (validBits_ == 0)
        return "the host's clock, from submission to fence: the device has no timestamps";
    return fmt::format("timestamps of the device, {} bits, {} ns a tick, {}", validBits_, nanosPerTick_,
                       getCalibratedTimestamps_ != nullptr
                           ? "aligned with the host's clock by calibrated timestamps"
                           : "each kernel centred between its submission and its fence, as the device "
                             "offers no calibrated timestamps");
}

std::int64_t Timestamps::nanosOf(std::uint64_t ticks) const {
    return static_cast<std::int64_t>(
        std::llround(static_cast<double>(ticks) * static_cast<double>(nanosPerTick_)));
}

void Timestamps::calibrate() {
    std::array<VkCalibratedTimestampInfoEXT, 2> infos{};
    for (VkCalibratedTimestampInfoEXT &info : infos)
        info.sType = VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT;
    infos[0].timeDomain = VK_TIME_DOMAIN_DEVICE_EXT;
    infos[1].timeDomain = hostDomain;
    std::array<std::uint64_t, 2> values{};
    std::uint64_t maxDeviation = 0;
    check(getCalibratedTimestamps_(device_, static_cast<std::uint32_t>(infos.size()), infos.data(),
                                   values.data(), &maxDeviation),
          "vkGetCalibratedTimestampsEXT for timestamps");
    calibration_ = Calibration{values[0], static_cast<std::int64_t>(values[1])};
}

} // namespace hyalite::core::gpu
