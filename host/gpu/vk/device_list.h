// Vulkan devices, their capabilities, and the choice among them: plain data, no Vulkan types.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core::gpu {

enum class DeviceType { Discrete, Integrated, Virtual, Cpu, Other };

[[nodiscard]] const char *deviceTypeName(DeviceType type);

class Instance;

struct DeviceInfo {
    int index = 0; ///< position in vkEnumeratePhysicalDevices
    std::string name;
    DeviceType type = DeviceType::Other;
    std::string driver;     ///< name and version, from the driver
    std::string apiVersion; ///< of Vulkan: "1.3.230"
    std::uint32_t vendorId = 0;
    std::uint32_t deviceId = 0;
    std::uint32_t subgroupSize = 0;
    std::uint32_t maxWorkgroupInvocations = 0;
    std::uint32_t maxWorkgroupCount = 0; ///< along x
    std::uint64_t maxStorageBufferBytes = 0;
    std::uint64_t maxTexelBufferElements = 0;
    std::uint32_t maxStorageBuffersPerStage = 0;
    std::uint32_t maxStorageImagesPerStage = 0; ///< storage texel buffers among them
    std::uint64_t maxAllocationBytes = 0;       ///< of one piece of memory
    std::uint64_t deviceMemoryBytes = 0;        ///< largest device-local heap
    /// As the start-up check finds them (startup_check.h), once it has run.
    std::uint32_t consecutiveLanes = 1;
    bool canShuffle = false;               ///< subgroups of compute kernels exchange and add values
    std::optional<bool> hasSlowShuffles{}; ///< as lane_exchange.h finds; empty: not measured
    bool hasTimestamps = false;
    bool hasCalibratedTimestamps = false;
    std::uint64_t maxQueryBoxes = 0;  ///< in the tree of ray queries; 0: it offers none
    bool isPortabilitySubset = false; ///< lacks a part of Vulkan, and says so by an extension
    std::uint32_t driverId = 0;       ///< VkDriverId; 0: unknown
    /// Its / and sqrt are known to be correctly rounded: see arithmetic.h.
    bool hasExactDivisionListed = false;
    // Float controls for float32. Equal bits are promised only with both.
    bool canRoundToNearestEven = false;
    bool canPreserveSignedZeroInfNan = false;
    std::string rejection; ///< why the device cannot be used, or empty

    [[nodiscard]] bool isUsable() const { return rejection.empty(); }
    [[nodiscard]] bool areBitsPromised() const {
        return canRoundToNearestEven && canPreserveSignedZeroInfNan;
    }
    [[nodiscard]] bool isSoftware() const { return type == DeviceType::Cpu; }
    [[nodiscard]] bool isLavapipe() const;
};

/// All devices that the Vulkan loader finds, usable or not. Throws Error{NoDevice}, naming what to install, if there is
/// no loader, no driver or no device.
[[nodiscard]] std::vector<DeviceInfo> listDevices();
/// The same, with an existing instance.
[[nodiscard]] std::vector<DeviceInfo> listDevices(const Instance &instance);

/// All devices, and an instance that keeps their drivers loaded: the loader unloads them with the last instance.
struct LoadedDevices {
    std::shared_ptr<Instance> instance;
    std::vector<DeviceInfo> devices;
};

/// Lists the devices as listDevices() does.
[[nodiscard]] LoadedDevices loadDevices();

/// Chooses by "auto" (hardware before software), an index, or part of a name; case and the vector width in the name of
/// lavapipe do not matter. Throws Error{NoDevice}, listing the devices, if none matches or the device is unusable.
[[nodiscard]] DeviceInfo chooseDevice(const std::vector<DeviceInfo> &devices, const std::string &wanted);

} // namespace hyalite::core::gpu
