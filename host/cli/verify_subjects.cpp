#include "host/cli/verify_subjects.h"

#include "host/base/message.h"
#include "host/cli/options.h"
#include "host/engine/open_backends.h"

#include <algorithm>

namespace hyalite::core {

namespace {

/// "all" leaves out what cannot be used, and says so.
std::vector<Subject> allSubjects() {
    std::vector<Subject> subjects{{"cpu", std::nullopt}};
    const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
    for (const gpu::DeviceInfo &device : devices)
        if (device.isUsable())
            subjects.push_back({std::to_string(device.index), device});
        else
            printMessage("note: left out {}: {}\n", device.name, device.rejection);
    if (subjects.size() == 1) // throws why
        static_cast<void>(gpu::chooseDevice(devices, "auto"));
    return subjects;
}

} // namespace

std::vector<Subject> subjectsOf(const std::vector<std::string> &names) {
    std::vector<Subject> subjects;
    const auto add = [&](const Subject &subject) {
        if (std::ranges::find(subjects, subject.name, &Subject::name) == subjects.end())
            subjects.push_back(subject);
    };
    for (const std::string &name : names)
        if (name == "all") {
            std::ranges::for_each(allSubjects(), add);
        } else if (name == "cpu") {
            add({"cpu", std::nullopt});
        } else if (isReference(name)) {
            refuseValue("--device", name, "all, cpu or a Vulkan device: double precision has other bits");
        } else {
            const gpu::DeviceInfo device = gpu::chooseDevice(gpu::listDevices(), name);
            add({std::to_string(device.index), device});
        }
    return subjects;
}

} // namespace hyalite::core
