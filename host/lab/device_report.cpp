#include "host/lab/device_report.h"

#include "host/base/version.h"
#include "host/gpu/arithmetic.h"
#include "host/gpu/render_config.h"
#include "host/gpu/vk/device.h"
#include "host/scene/names.h"

namespace hyalite::core {

std::vector<std::pair<std::string_view, std::string_view>> chosenKernels(const gpu::DeviceInfo &device,
                                                                         const Tuning &tuning) {
    std::vector<std::pair<std::string_view, std::string_view>> chosen;
    for (const auto &[name, workload] : gpu::workloadNames) {
        const gpu::KernelRow *measured = tuning.kernels[static_cast<std::size_t>(workload)];
        chosen.emplace_back(name, (measured != nullptr ? *measured : chooseKernel(device, workload)).name);
    }
    return chosen;
}

std::string equalBitsOf(const gpu::DeviceInfo &device, Observer &observer) {
    if (device.areBitsPromised())
        return "promised";
    if (!device.isUsable())
        return "none: " + gpu::explainUnpromisedBits(device);
    gpu::Device opened(device);
    return gpu::describe(
        guaranteeOf(gpu::guaranteeOf(device, gpu::checkDevice(opened)), readTuning(device, observer)));
}

nlohmann::ordered_json deviceToJson(const gpu::DeviceInfo &device, Observer &observer) {
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
    entry["canQueryRays"] = device.maxQueryBoxes > 0;
    entry["canRoundToNearestEven"] = device.canRoundToNearestEven;
    entry["canPreserveSignedZeroInfNan"] = device.canPreserveSignedZeroInfNan;
    entry["hasExactDivisionListed"] = device.hasExactDivisionListed;
    const Tuning tuning = readTuning(device, observer);
    for (const auto &[workload, kernel] : chosenKernels(device, tuning))
        entry["kernels"][std::string(workload)] = kernel;
    entry["areKernelsMeasured"] = tuning.isMeasured();
    entry["areBitsPromised"] = device.areBitsPromised();
    entry["equalBits"] = equalBitsOf(device, observer);
    entry["isUsable"] = device.isUsable();
    if (!device.isUsable())
        entry["rejection"] = device.rejection;
    return entry;
}

nlohmann::ordered_json referenceToJson() {
    nlohmann::ordered_json reference;
    reference["name"] = "cpu";
    reference["type"] = "reference renderer";
    reference["driver"] = "hyalite " HYALITE_VERSION;
    reference["areBitsPromised"] = true;
    reference["equalBits"] = "promised";
    reference["isUsable"] = true;
    return reference;
}

} // namespace hyalite::core
