// This machine, as far as rendering is concerned: system, processors, graphics cards, and how drivers are to be found.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {

// PCI vendors whose graphics cards compute by Vulkan.
inline constexpr std::uint32_t vendorAmd = 0x1002;
inline constexpr std::uint32_t vendorIntel = 0x8086;
inline constexpr std::uint32_t vendorNvidia = 0x10de;

/// A graphics card on the PCI bus.
struct GraphicsCard {
    std::string address; ///< "0000:01:00.0"
    std::uint32_t vendorId = 0;
    std::uint32_t deviceId = 0;
    std::string kernelDriver; ///< "amdgpu"; empty: none has taken it
};

/// A file in /dev by which drivers reach a graphics card.
struct DeviceNode {
    std::filesystem::path file;
    std::string group; ///< name or number
    bool isAccessible = false;
};

struct DriverFile {
    std::filesystem::path manifest;
    std::string fault; ///< gpu::faultOf()
};

struct Machine {
    std::string system;       ///< "Debian GNU/Linux 12 (bookworm)"; empty if it does not say
    std::string kernel;       ///< "Linux 6.1.0-21-amd64"
    std::string architecture; ///< "x86_64"
    std::string libc;         ///< "glibc 2.36"
    std::string processor;    ///< model; empty if the system does not say
    unsigned threadCount = 0;
    std::optional<std::uint64_t> memoryBytes{};
    bool isContainer = false;
    std::string nvidiaModule; ///< version of NVIDIA's kernel module; empty: it is not loaded
    std::vector<GraphicsCard> cards{};
    std::vector<DeviceNode> nodes{};
    std::vector<std::pair<std::string, std::string>> variables{}; ///< those that are set and matter
    std::vector<DriverFile> drivers{};

    /// The value of a variable, or empty.
    [[nodiscard]] std::string_view variable(std::string_view name) const;
};

/// Looks at /dev, /etc, /proc and /sys in `root`, and at the environment; not for drivers, whose libraries would have to be
/// loaded. What cannot be read is left out.
[[nodiscard]] Machine describeMachine(const std::filesystem::path &root = "/");

} // namespace hyalite::core
