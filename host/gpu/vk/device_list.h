// Which Vulkan devices there are, what they can do, and which one to use: plain data, no Vulkan types.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::gpu {

enum class DeviceType { Discrete, Integrated, Virtual, Cpu, Other };

[[nodiscard]] const char *deviceTypeName(DeviceType type);

class Instance;

struct DeviceInfo {
    int index = 0; ///< in the order of vkEnumeratePhysicalDevices
    std::string name;
    DeviceType type = DeviceType::Other;
    std::string driver;     ///< name and version as the driver calls them
    std::string apiVersion; ///< of Vulkan: "1.3.230"
    std::uint32_t vendorId = 0;
    std::uint32_t deviceId = 0;
    std::uint32_t subgroupSize = 0;
    std::uint32_t maxWorkgroupInvocations = 0;
    std::uint32_t maxWorkgroupCount = 0; ///< along x
    std::uint64_t maxStorageBufferBytes = 0;
    std::uint64_t maxTexelBufferElements = 0;
    std::uint32_t maxStorageBuffersPerStage = 0;
    std::uint64_t deviceMemoryBytes = 0; ///< largest device-local heap
    bool hasTimestamps = false;
    bool hasCalibratedTimestamps = false;
    std::uint32_t driverId = 0; ///< VkDriverId; 0: not told
    bool hasExactDivisionListed =
        false; ///< its / and sqrt are known to be correctly rounded: see arithmetic.h
    // Float controls of float32 arithmetic: without both no bits are promised.
    bool canRoundToNearestEven = false;
    bool canPreserveSignedZeroInfNan = false;
    std::string rejection; ///< why it cannot be used, or empty

    [[nodiscard]] bool isUsable() const { return rejection.empty(); }
    [[nodiscard]] bool areBitsPromised() const {
        return canRoundToNearestEven && canPreserveSignedZeroInfNan;
    }
    [[nodiscard]] bool isSoftware() const { return type == DeviceType::Cpu; }
};

/// All devices that the Vulkan loader finds, usable or not. Throws Error{NoDevice}, saying what to install, where
/// there is no loader, no driver or no device at all.
[[nodiscard]] std::vector<DeviceInfo> listDevices();
/// The same, by an instance that stays.
[[nodiscard]] std::vector<DeviceInfo> listDevices(const Instance &instance);

/// Chooses by "auto" (a hardware GPU before a software one), an index, or a part of a name, in any case and whatever
/// the width of vectors in it. Throws Error{NoDevice} listing what there is, if none or an unusable one is meant.
[[nodiscard]] DeviceInfo chooseDevice(const std::vector<DeviceInfo> &devices, const std::string &wanted);

} // namespace hyalite::gpu
