#include "host/gpu/vk/device_list.h"

#include "host/base/error.h"
#include "host/base/letter_case.h"
#include "host/gpu/vk/instance.h"
#include "host/gpu/vk/physical_device.h"
#include "shaders/layout/layout.h"

#include <fmt/format.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <regex>
#include <utility>

namespace hyalite::core::gpu {

namespace {

/// The name of lavapipe contains its vector width, which depends on our own settings (processor_use.h).
std::string withoutVectorWidth(const std::string &name) {
    static const std::regex width(", [0-9]+ bits");
    return std::regex_replace(name, width, "");
}

bool isNamed(const DeviceInfo &device, const std::string &wanted) {
    const std::string name = lowerCase(device.name);
    const std::string part = lowerCase(wanted);
    return !part.empty() && (name.find(part) != std::string::npos ||
                             withoutVectorWidth(name).find(withoutVectorWidth(part)) != std::string::npos);
}

std::string describeAll(const std::vector<DeviceInfo> &devices) {
    std::string text;
    for (const DeviceInfo &device : devices)
        text += fmt::format("\n  {}  {} ({}){}", device.index, device.name, deviceTypeName(device.type),
                            device.isUsable() ? "" : ", unusable: " + device.rejection);
    return text;
}

int preference(const DeviceInfo &device) {
    switch (device.type) {
    case DeviceType::Discrete:
        return 0;
    case DeviceType::Integrated:
        return 1;
    case DeviceType::Virtual:
        return 2;
    case DeviceType::Other:
        return 3;
    case DeviceType::Cpu:
        break;
    }
    return 4;
}

std::optional<int> parseIndex(const std::string &text) {
    int index = 0;
    const char *end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, index);
    if (text.empty() || result.ec != std::errc{} || result.ptr != end)
        return std::nullopt;
    return index;
}

} // namespace

const char *deviceTypeName(DeviceType type) {
    switch (type) {
    case DeviceType::Discrete:
        return "discrete GPU";
    case DeviceType::Integrated:
        return "integrated GPU";
    case DeviceType::Virtual:
        return "virtual GPU";
    case DeviceType::Cpu:
        return "CPU, software";
    case DeviceType::Other:
        break;
    }
    return "other";
}

bool DeviceInfo::isLavapipe() const { return driverId == VK_DRIVER_ID_MESA_LLVMPIPE; }

std::vector<DeviceInfo> listDevices() { return listDevices(Instance()); }

std::vector<DeviceInfo> listDevices(const Instance &instance) {
    std::vector<DeviceInfo> devices;
    for (VkPhysicalDevice physical : instance.physicalDevices()) {
        devices.push_back(describePhysicalDevice(physical));
        devices.back().index = static_cast<int>(devices.size()) - 1;
    }
    if (devices.empty())
        throw Error(ErrorKind::NoDevice,
                    "the Vulkan loader finds no device: install your GPU's driver, or the "
                    "package mesa-vulkan-drivers, whose lavapipe renders on any CPU");
    return devices;
}

LoadedDevices loadDevices() {
    auto instance = std::make_shared<Instance>();
    std::vector<DeviceInfo> devices = listDevices(*instance);
    return {std::move(instance), std::move(devices)};
}

DeviceInfo chooseDevice(const std::vector<DeviceInfo> &devices, const std::string &wanted) {
    const auto fail = [&](const std::string &why) {
        return Error(ErrorKind::NoDevice, fmt::format("{}. There are:{}\n  cpu  the reference renderer", why,
                                                      describeAll(devices)));
    };
    if (wanted == "auto") {
        const DeviceInfo *best = nullptr;
        for (const DeviceInfo &device : devices)
            if (device.isUsable() && (best == nullptr || preference(device) < preference(*best)))
                best = &device;
        if (best == nullptr)
            throw fail("no Vulkan device is usable");
        return *best;
    }
    const std::optional<int> index = parseIndex(wanted);
    for (const DeviceInfo &device : devices) {
        const bool isMeant = index ? device.index == *index : isNamed(device, wanted);
        if (!isMeant)
            continue;
        if (!device.isUsable())
            throw fail(
                fmt::format("device {}, {}, is unusable: {}", device.index, device.name, device.rejection));
        return device;
    }
    throw fail(fmt::format("no device matches '{}'", wanted));
}

} // namespace hyalite::core::gpu
