#include "host/gpu/devices.h"
#include "host/cli/commands.h"
#include "host/gpu/arithmetic.h"
#include "host/gpu/batching.h"
#include "host/report/json_text.h"
#include "host/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace hyalite {

namespace {

constexpr double bytesPerMebibyte = 1024.0 * 1024.0;

void printTable(const std::vector<gpu::DeviceInfo> &devices) {
    for (const gpu::DeviceInfo &device : devices) {
        fmt::print("{}  {}\n", device.index, device.name);
        fmt::print("   type        {}\n", gpu::deviceTypeName(device.type));
        fmt::print("   driver      {}, Vulkan {}\n", device.driver, device.apiVersion);
        fmt::print("   memory      {:.0f} MiB, at most {:.0f} MiB in a storage buffer\n",
                   static_cast<double>(device.deviceMemoryBytes) / bytesPerMebibyte,
                   static_cast<double>(device.maxStorageBufferBytes) / bytesPerMebibyte);
        fmt::print("   kernels     subgroups of {}, workgroups of up to {}, timestamps: {}\n",
                   device.subgroupSize, device.maxWorkgroupInvocations, device.hasTimestamps ? "yes" : "no");
        fmt::print("   float32     round to nearest even: {}, signed zero, infinity and NaN kept: {}\n",
                   device.canRoundToNearestEven ? "yes" : "not offered",
                   device.canPreserveSignedZeroInfNan ? "yes" : "not offered");
        fmt::print("   arithmetic  {} / and sqrt\n", device.hasExactDivisionListed ? "native" : "own");
        fmt::print("   kernel      {}, unless --kernel names another\n",
                   gpu::kernelName(gpu::completed({}, device)));
        const std::string unpromised = gpu::explainUnpromisedBits(device);
        fmt::print("   equal bits  {}\n", unpromised.empty() ? "promised" : "not promised: " + unpromised);
        fmt::print("   usable      {}\n", device.isUsable() ? "yes" : "no: " + device.rejection);
    }
    fmt::print("cpu  the reference renderer, without Vulkan\n");
}

void printJson(const std::vector<gpu::DeviceInfo> &devices) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const gpu::DeviceInfo &device : devices) {
        nlohmann::ordered_json entry;
        entry["index"] = device.index;
        entry["name"] = device.name;
        entry["type"] = gpu::deviceTypeName(device.type);
        entry["driver"] = device.driver;
        entry["apiVersion"] = device.apiVersion;
        entry["vendorId"] = device.vendorId;
        entry["deviceId"] = device.deviceId;
        entry["deviceMemoryBytes"] = device.deviceMemoryBytes;
        entry["maxStorageBufferBytes"] = device.maxStorageBufferBytes;
        entry["maxStorageBuffersPerStage"] = device.maxStorageBuffersPerStage;
        entry["maxWorkgroupInvocations"] = device.maxWorkgroupInvocations;
        entry["maxWorkgroupCount"] = device.maxWorkgroupCount;
        entry["subgroupSize"] = device.subgroupSize;
        entry["hasTimestamps"] = device.hasTimestamps;
        entry["canRoundToNearestEven"] = device.canRoundToNearestEven;
        entry["canPreserveSignedZeroInfNan"] = device.canPreserveSignedZeroInfNan;
        entry["hasExactDivisionListed"] = device.hasExactDivisionListed;
        entry["kernel"] = gpu::kernelName(gpu::completed({}, device));
        entry["areBitsPromised"] = device.areBitsPromised();
        entry["isUsable"] = device.isUsable();
        if (!device.isUsable())
            entry["rejection"] = device.rejection;
        list.push_back(entry);
    }
    nlohmann::ordered_json reference; // without an index: it is chosen by its name
    reference["name"] = "cpu";
    reference["type"] = "reference renderer";
    reference["driver"] = "hyalite " HYALITE_VERSION;
    reference["areBitsPromised"] = true;
    reference["isUsable"] = true;
    list.push_back(reference);
    fmt::print("{}", jsonText(list));
}

} // namespace

void addDevicesCommand(CLI::App &app, CommandContext &) {
    CLI::App *command = app.add_subcommand("devices", "list the Vulkan devices and what they can do");
    const auto isJson = std::make_shared<bool>(false);
    command->add_flag("--json", *isJson, "print JSON");
    command->callback([isJson] {
        const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
        if (*isJson)
            printJson(devices);
        else
            printTable(devices);
    });
}

} // namespace hyalite
