#include "host/engine/open_backends.h"

#include "host/base/error.h"
#include "host/engine/cpu_backend.h"
#include "host/engine/device_backend.h"
#include "host/engine/shared_backend.h"
#include "host/gpu/vk/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hyalite::core {

namespace {

gpu::LoadedDevices loadDevices() {
    try {
        return gpu::loadDevices();
    } catch (const Error &error) {
        if (error.kind != ErrorKind::NoDevice)
            throw;
        throw Error(error.kind, error.what(), Remedy::ReferenceInstead);
    }
}

std::unique_ptr<Backend> open(const std::string &name, int threadCount, const gpu::RenderConfig &config,
                              Observer &observer) {
    if (isReference(name) && config.kernel != nullptr)
        throw Error(ErrorKind::Usage,
                    fmt::format("only Vulkan devices have kernels to choose from, {} has none", name),
                    Remedy::NoKernelChoice);
    if (name == "cpu")
        return makeCpuBackend(reference::Precision::Float32, threadCount);
    if (name == "cpu-double")
        return makeCpuBackend(reference::Precision::Float64, threadCount);
    const gpu::LoadedDevices loaded = loadDevices(); // until the chosen device has an instance of its own
    return makeDeviceBackend(gpu::chooseDevice(loaded.devices, name), config, observer);
}

/// A renderer that the names mean: the CPU, or a device.
using Choice = std::optional<gpu::DeviceInfo>;

/// "all": the usable devices; but one alone of those that compute on the CPU.
std::vector<Choice> chooseAll(const std::vector<gpu::DeviceInfo> &devices, std::vector<std::string> &notes) {
    std::vector<Choice> chosen;
    std::string software;
    const auto leaveOut = [&](const std::string &name, const std::string &why) {
        notes.push_back(fmt::format("left out {}: {}", name, why));
    };
    for (const gpu::DeviceInfo &device : devices) {
        if (!device.isUsable()) {
            leaveOut(device.name, device.rejection);
        } else if (device.isSoftware() && !software.empty()) {
            leaveOut(device.name, software + " computes on the same cores");
        } else {
            chosen.emplace_back(device);
            if (device.isSoftware())
                software = device.name;
        }
    }
    return chosen;
}

std::vector<Choice> chooseNamed(const RendererNames &names, const std::vector<gpu::DeviceInfo> &devices) {
    std::vector<Choice> chosen;
    for (const std::string &name : names) {
        if (name == "cpu-double" || name == "all")
            throw OverrideError("device", name + " cannot be combined with other devices");
        Choice choice;
        if (name != "cpu")
            choice = gpu::chooseDevice(devices, name);
        const auto isSame = [&](const Choice &other) {
            return choice && other ? choice->index == other->index : choice.has_value() == other.has_value();
        };
        if (std::ranges::any_of(chosen, isSame))
            throw OverrideError("device", name + " is given twice");
        chosen.push_back(std::move(choice));
    }
    return chosen;
}

OpenedRenderers openAll(const RendererNames &names, int threadCount, const gpu::RenderConfig &config,
                        Observer &observer) {
    const bool isAll = names.size() == 1 && names.front() == "all";
    if (names.size() == 1 && !isAll)
        return {open(names.front(), threadCount, config, observer), {}};
    OpenedRenderers opened;
    gpu::LoadedDevices loaded; // until those that are chosen have instances of their own
    try {
        loaded = loadDevices();
    } catch (const Error &error) {
        if (!isAll || error.kind != ErrorKind::NoDevice)
            throw;
        opened.notes.push_back(fmt::format("cpu alone: {}", error.what()));
    }
    const std::vector<Choice> chosen =
        isAll ? chooseAll(loaded.devices, opened.notes) : chooseNamed(names, loaded.devices);
    std::vector<std::unique_ptr<Backend>> members;
    std::optional<Error> lastFailure;
    std::string software;
    const auto openOne = [&](const Choice &choice) {
        const auto leaveOut = [&](const std::string &why) {
            opened.notes.push_back(fmt::format("left out {}: {}", choice ? choice->name : "cpu", why));
        };
        try {
            std::unique_ptr<Backend> member =
                choice ? makeDeviceBackend(*choice, config, observer)
                       : makeCpuBackend(reference::Precision::Float32, threadCount);
            if (member->bits().degree == gpu::BitDegree::None)
                leaveOut(fmt::format("its bits may be its own: {}; `hyalite verify` finds out",
                                     member->bits().reason));
            else {
                members.push_back(std::move(member));
                if (choice && choice->isSoftware())
                    software = choice->name;
            }
        } catch (const Error &error) {
            lastFailure.emplace(error);
            leaveOut(error.what());
        }
    };
    std::ranges::for_each(chosen, openOne);
    if (isAll && software.empty())
        openOne({});
    else if (isAll)
        opened.notes.push_back(fmt::format("left out cpu: {} computes on the same cores", software));
    if (members.empty() && lastFailure)
        throw Error(*lastFailure);
    if (members.empty())
        throw Error(ErrorKind::NoDevice, "no device is left: " + opened.notes.back());
    opened.backend = members.size() == 1 ? std::move(members.front()) : shareBackends(std::move(members));
    return opened;
}

void announceDriver(Observer &observer, gpu::ProcessorUse processors, const gpu::RenderConfig &config) {
    processors.hasStack = config.kernel != nullptr && walksWithStack(*config.kernel);
    observer.beforeDriver(processors);
}

} // namespace

bool isReference(const std::string &name) { return name == "cpu" || name == "cpu-double"; }

gpu::RenderConfig renderConfigFor(const DeviceOptions &options) {
    gpu::RenderConfig config;
    config.dispatchSeconds = options.maxDispatchMillis * 1e-3;
    config.kernel = options.kernel.value_or(nullptr);
    return config;
}

gpu::ProcessorUse processorsFor(int threadCount, const SceneOutline &outline) {
    return {threadCount, outline.hasMeshes, outline.settings.integrator, outline.settings.maxDepth};
}

gpu::ProcessorUse processorsFor(int threadCount, const PreparedScene &scene) {
    return processorsFor(threadCount, SceneOutline{scene.packed.hasTriangles, scene.loaded.settings});
}

std::unique_ptr<Backend> openBackend(const std::string &name, Observer &observer,
                                     const gpu::ProcessorUse &processors, const gpu::RenderConfig &config) {
    if (!isReference(name))
        announceDriver(observer, processors, config);
    return open(name, processors.threadCount, config, observer);
}

OpenedRenderers openRenderers(const RendererNames &names, Observer &observer,
                              const gpu::ProcessorUse &processors, const gpu::RenderConfig &config) {
    return beginOpeningRenderers(names, observer, processors, config).get();
}

std::future<OpenedRenderers> beginOpeningRenderers(const RendererNames &names, Observer &observer,
                                                   const gpu::ProcessorUse &processors,
                                                   const gpu::RenderConfig &config) {
    if (!std::ranges::all_of(names, isReference))
        announceDriver(observer, processors, config); // here, as the other thread may read the environment
    return std::async(std::launch::async,
                      [=, &observer] { return openAll(names, processors.threadCount, config, observer); });
}

} // namespace hyalite::core
