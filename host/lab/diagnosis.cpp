#include "host/lab/diagnosis.h"

#include "host/gpu/vk/bundled_manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <string_view>

namespace hyalite::core {

namespace {

constexpr std::string_view mesaPackages = "the package mesa-vulkan-drivers (Debian, Ubuntu, Fedora), or "
                                          "vulkan-radeon, vulkan-intel and vulkan-swrast (Arch)";

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

std::string vendorName(std::uint32_t vendor) {
    return vendor == vendorAmd ? "AMD" : vendor == vendorIntel ? "Intel" : "NVIDIA";
}

/// What dlopen says of a driver's library, as advice.
std::string remedyFor(const DriverFile &driver) {
    std::smatch match;
    if (has(driver.fault, "GLIBC"))
        return "the driver needs newer libraries than this program was given: unset LD_LIBRARY_PATH, or use "
               "the driver of "
               "this system's release";
    if (std::regex_search(driver.fault, match,
                          std::regex("(lib[^ :/]+\\.so[.0-9]*): cannot open shared object"))) {
        const std::string missing = match[1];
        if (missing.starts_with("libX"))
            return fmt::format(
                "install {}: NVIDIA's driver needs libX11 and libXext (packages libx11-6 and libxext6 of "
                "Debian and Ubuntu) also without a display",
                missing);
        return fmt::format("install the package that has {}, or install the driver's package again", missing);
    }
    return "install the driver's package again, or remove this file";
}

void judgeDrivers(const Machine &machine, std::vector<Finding> &findings) {
    for (const DriverFile &driver : machine.drivers)
        if (!driver.fault.empty() && !has(driver.fault, "wrong ELF class")) // of programs with 32 bits
            findings.push_back({"driver-file", true, driver.fault, remedyFor(driver)});
    if (machine.drivers.empty())
        findings.push_back(
            {"no-driver", true,
             "no Vulkan driver is installed: the loader finds no driver's file (ICD) in its folders, such as "
             "/usr/share/vulkan/icd.d",
             fmt::format("install the driver of your graphics card; or {}, whose lavapipe renders on any "
                         "CPU. The device cpu needs none",
                         mesaPackages)});
    if (machine.variable("VK_DRIVER_FILES").ends_with(gpu::bundledManifest)) {
        findings.push_back({"bundled-driver", false,
                            "the archive's own driver, lavapipe, is used: the CPU computes",
                            "install the driver of your graphics card, if there is one"});
        return;
    }
    for (const char *name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"})
        if (const std::string_view value = machine.variable(name); !value.empty())
            findings.push_back({"driver-variable", false,
                                fmt::format("{} is {}: the loader looks at no other driver", name, value),
                                "unset it to see all drivers"});
    for (const char *name : {"VK_LOADER_DRIVERS_SELECT", "VK_LOADER_DRIVERS_DISABLE"})
        if (const std::string_view value = machine.variable(name); !value.empty())
            findings.push_back({"driver-variable", false,
                                fmt::format("{} is {}: some drivers are left out", name, value),
                                "unset it to see all drivers"});
}

/// Files of /dev that this user may not open.
void judgeNodes(const Machine &machine, std::vector<Finding> &findings) {
    for (const DeviceNode &node : machine.nodes)
        if (!node.isAccessible)
            findings.push_back(
                {"device-node", true,
                 fmt::format("{} is of the group {}, and this user may not open it", node.file.string(),
                             node.group),
                 machine.isContainer
                     ? fmt::format("start the container with that group, or as a user who is in it")
                     : fmt::format("sudo usermod -aG {} \"$USER\", and log in again", node.group)});
}

bool isListed(const GraphicsCard &card, std::span<const ListedDevice> devices) {
    return std::ranges::any_of(devices, [&](const ListedDevice &device) {
        return device.vendorId == card.vendorId && device.deviceId == card.deviceId;
    });
}

bool hasNode(const Machine &machine, std::string_view prefix) {
    return std::ranges::any_of(machine.nodes, [&](const DeviceNode &node) {
        return node.file.filename().string().starts_with(prefix);
    });
}

Finding missingNvidia(const Machine &machine, const std::string &card) {
    const auto finding = [&](const char *code, const std::string &why, const std::string &remedy) {
        return Finding{code, true, fmt::format("{} is no Vulkan device: {}", card, why), remedy};
    };
    if (machine.nvidiaModule.empty())
        return finding("nvidia-module", "NVIDIA's kernel module is not loaded",
                       "install NVIDIA's driver (the package nvidia-driver of Debian; ubuntu-drivers install "
                       "on Ubuntu), and "
                       "start anew; in a container, on the machine that it runs on");
    const std::string_view capabilities = machine.variable("NVIDIA_DRIVER_CAPABILITIES");
    const bool isGraphic = has(capabilities, "graphics") || has(capabilities, "all");
    if (machine.isContainer && !isGraphic)
        return finding(
            "nvidia-capabilities",
            fmt::format(
                "NVIDIA_DRIVER_CAPABILITIES {}, and without graphics a container has no Vulkan driver",
                capabilities.empty() ? "is not set" : fmt::format("is {}", capabilities)),
            "start the container with NVIDIA_DRIVER_CAPABILITIES=all, or compute,graphics,utility");
    if (!hasNode(machine, "nvidia"))
        return finding(
            "nvidia-node", "there is no /dev/nvidia0",
            "give the container the device, as NVIDIA's container toolkit does; elsewhere load the module: "
            "nvidia-modprobe -u -c 0");
    const bool hasManifest = std::ranges::any_of(machine.drivers, [](const DriverFile &driver) {
        return has(driver.manifest.filename().string(), "nvidia");
    });
    if (!hasManifest)
        return finding(
            "nvidia-driver-file",
            fmt::format("its kernel module {} is loaded, and its Vulkan driver is missing",
                        machine.nvidiaModule),
            "install the driver's part for graphics, of the same version: nvidia-vulkan-icd of Debian, "
            "libnvidia-gl-VERSION of Ubuntu, nvidia-utils of Arch");
    return finding(
        "nvidia-silent", "its driver is installed, and lists no device",
        "see that the module's version is the driver's (nvidia-smi), and what VK_LOADER_DEBUG=all says");
}

Finding missingOther(const Machine &machine, const GraphicsCard &card, const std::string &name) {
    const auto finding = [&](const char *code, const std::string &why, const std::string &remedy) {
        return Finding{code, true, fmt::format("{} is no Vulkan device: {}", name, why), remedy};
    };
    if (card.kernelDriver.empty())
        return finding(
            "kernel-driver", "no driver of the kernel has taken it",
            "install its firmware and a newer kernel; the kernel's log (dmesg) says what is missing");
    if (!hasNode(machine, "renderD"))
        return finding("render-node", "there is no /dev/dri/renderD128",
                       machine.isContainer
                           ? "give the container the device /dev/dri"
                           : "load its kernel module, without nomodeset among the kernel's parameters");
    const std::string_view word = card.vendorId == vendorAmd ? "radeon" : "intel";
    const bool hasManifest = std::ranges::any_of(machine.drivers, [&](const DriverFile &driver) {
        const std::string file = driver.manifest.filename().string();
        return has(file, word) || (card.vendorId == vendorAmd && has(file, "amd"));
    });
    if (!hasManifest)
        return finding("card-driver-file", "its Vulkan driver is not installed",
                       fmt::format("install {}", mesaPackages));
    return finding(
        "card-silent",
        fmt::format("its driver is installed, and lists no device (kernel driver: {})", card.kernelDriver),
        "it may be older than Vulkan, or newer than the driver: VK_LOADER_DEBUG=all says more");
}

void judgeCards(const Machine &machine, std::span<const ListedDevice> devices,
                std::vector<Finding> &findings) {
    for (const GraphicsCard &card : machine.cards) {
        const bool isKnown =
            card.vendorId == vendorAmd || card.vendorId == vendorIntel || card.vendorId == vendorNvidia;
        if (!isKnown || isListed(card, devices) ||
            card.kernelDriver == "vfio-pci") // it is a virtual machine's
            continue;
        const std::string name = fmt::format("the graphics card {} ({} {:04x})", card.address,
                                             vendorName(card.vendorId), card.deviceId);
        findings.push_back(card.vendorId == vendorNvidia ? missingNvidia(machine, name)
                                                         : missingOther(machine, card, name));
    }
}

void judgeDevices(std::span<const ListedDevice> devices, const std::string &loaderError,
                  std::vector<Finding> &findings) {
    if (!loaderError.empty())
        findings.push_back({"no-device", true, loaderError, ""});
    for (const ListedDevice &device : devices)
        if (!device.rejection.empty())
            findings.push_back({"unusable-device", true,
                                fmt::format("device {}, {}, cannot be used: {}", device.index, device.name,
                                            device.rejection),
                                "a newer driver may offer more"});
    const bool isAlone = std::ranges::all_of(devices, &ListedDevice::isSoftware);
    if (!devices.empty() && isAlone)
        findings.push_back({"software-only", false, "all Vulkan devices are software: the CPU computes", ""});
}

} // namespace

std::vector<Finding> diagnose(const Machine &machine, std::span<const ListedDevice> devices,
                              const std::string &loaderError) {
    std::vector<Finding> findings;
    judgeDevices(devices, loaderError, findings);
    judgeDrivers(machine, findings);
    judgeNodes(machine, findings);
    judgeCards(machine, devices, findings);
    std::stable_partition(findings.begin(), findings.end(),
                          [](const Finding &finding) { return finding.isProblem; });
    return findings;
}

} // namespace hyalite::core
