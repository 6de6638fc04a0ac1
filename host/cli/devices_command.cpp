#include "host/base/atomic_file.h"
#include "host/base/json_text.h"
#include "host/base/message.h"
#include "host/cli/commands.h"
#include "host/cli/terminal_observer.h"
#include "host/gpu/render_config.h"
#include "host/gpu/vk/device_list.h"
#include "host/lab/device_report.h"
#include "host/lab/tune.h"
#include "host/process/apart.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

constexpr double bytesPerMebibyte = 1024.0 * 1024.0;

void printKernels(const gpu::DeviceInfo &device, Observer &observer) {
    const Tuning tuning = readTuning(device, observer);
    std::string text;
    for (const auto &[workload, kernel] : chosenKernels(device, tuning))
        text += fmt::format("{}{} for {}", text.empty() ? "" : ", ", kernel, workload);
    printResult("   kernel      {}: {}\n", text,
                tuning.isMeasured() ? "as measured on " + tuning.date
                                    : "by its type; `hyalite devices --tune` measures");
}

void printTable(const std::vector<gpu::DeviceInfo> &devices, Observer &observer) {
    for (const gpu::DeviceInfo &device : devices) {
        printResult("{}  {}\n", device.index, device.name);
        printResult("   type        {}\n", gpu::deviceTypeName(device.type));
        printResult("   driver      {}, Vulkan {}\n", device.driver, device.apiVersion);
        printResult("   memory      {:.0f} MiB, at most {:.0f} MiB in a storage buffer\n",
                    static_cast<double>(device.deviceMemoryBytes) / bytesPerMebibyte,
                    static_cast<double>(device.maxStorageBufferBytes) / bytesPerMebibyte);
        printResult("   kernels     subgroups of {}, workgroups of up to {}, timestamps: {}\n",
                    device.subgroupSize, device.maxWorkgroupInvocations, device.hasTimestamps ? "yes" : "no");
        printResult("   float32     round to nearest even: {}, signed zero, infinity and NaN kept: {}\n",
                    device.canRoundToNearestEven ? "yes" : "not offered",
                    device.canPreserveSignedZeroInfNan ? "yes" : "not offered");
        printResult("   arithmetic  {} / and sqrt\n", device.hasExactDivisionListed ? "native" : "own");
        printKernels(device, observer);
        printResult("   ray query   {}\n", device.maxQueryBoxes > 0
                                               ? "by `--kernel ray-query` alone: not measured on a GPU"
                                               : "not offered");
        printResult("   equal bits  {}\n", equalBitsOf(device, observer));
        printResult("   usable      {}\n", device.isUsable() ? "yes" : "no: " + device.rejection);
    }
    printResult("cpu  the reference renderer, without Vulkan\n");
}

void printJson(const std::vector<gpu::DeviceInfo> &devices, Observer &observer) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const gpu::DeviceInfo &device : devices)
        list.push_back(deviceToJson(device, observer));
    list.push_back(referenceToJson());
    fmt::print("{}", cleanText(jsonText(list)));
}

/// Measures the kernels on one device and stores the fastest ones.
void tune(const std::string &deviceName, Observer &observer) {
    const std::filesystem::path file = tuningFile();
    std::error_code error;
    if (std::filesystem::exists(file.parent_path(), error))
        static_cast<void>(AtomicFile(file)); // fails now if it cannot be written half a minute later
    const std::vector<KernelRates> all = measureKernels(deviceName, observer, inOwnProcess);
    const gpu::DeviceInfo device = gpu::chooseDevice(gpu::listDevices(), deviceName);
    printResult("{}  {}\n\n{:<11} {:<11}", device.index, device.name, "Mray/s", "scene");
    for (const gpu::KernelRow &kernel : gpu::kernelTable)
        printResult(" {:>12}", kernel.name);
    printResult("   auto\n");
    Tuning tuning = readTuning(device, observer);
    tuning.date = today();
    for (const KernelRates &rates : all) {
        printResult("{:<11} {:<11}", nameIn(gpu::workloadNames, rates.workload), rates.scene);
        for (const double rate : rates.megaraysPerSecond)
            printResult(" {:>12}", rate > 0.0 ? fmt::format("{:.3g}", rate) : "-");
        const gpu::KernelRow &kernel = gpu::kernelTable[rates.best];
        printResult("   {}\n", kernel.name);
        tuning.kernels[static_cast<std::size_t>(rates.workload)] = &kernel;
    }
    storeTuning(device, tuning, observer);
    printResult("\nkept in {}\n", file.string());
}

struct DevicesOptions {
    bool isJson = false;
    bool isTuning = false;
    std::string device = "auto";
};

} // namespace

void addDevicesCommand(CLI::App &app, CommandContext &) {
    CLI::App *command = app.add_subcommand("devices", "list the Vulkan devices and what they can do");
    const auto options = std::make_shared<DevicesOptions>();
    CLI::Option *json = command->add_flag("--json", options->isJson, "print JSON");
    CLI::Option *tuning =
        command->add_flag("--tune", options->isTuning,
                          "measure the kernels on a device for half a minute; later renders use the "
                          "fastest. The image is the same with each");
    tuning->excludes(json);
    command->add_option("--device", options->device, "for --tune: auto, an index or part of a name")
        ->type_name("DEVICE")
        ->capture_default_str()
        ->needs(tuning);
    command->callback([options] {
        TerminalObserver observer(false);
        if (options->isTuning) {
            tune(options->device, observer);
            return;
        }
        const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
        if (options->isJson)
            printJson(devices, observer);
        else
            printTable(devices, observer);
    });
}

} // namespace hyalite::core
