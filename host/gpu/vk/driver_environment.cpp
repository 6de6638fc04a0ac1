#include "host/gpu/vk/driver_environment.h"

#include "host/base/error.h"
#include "host/base/host_memory.h"
#include "host/base/quantities.h"
#include "host/gpu/vk/check.h"
#include "host/gpu/vk/driver_manifests.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hyalite::core::gpu {

namespace {

struct Variables {
    std::string values; ///< "; VK_DRIVER_FILES is /a.json:/b.json"
    std::string faults; ///< "; there is no file /a.json"
};

Variables readVariables() {
    Variables variables;
    for (const DriverVariable &variable : driverVariables()) {
        variables.values += fmt::format("; {} is {}", variable.name, variable.value);
        for (const std::filesystem::path &file : variable.files())
            if (const std::string fault = faultOf(file);
                !fault.empty() && variables.faults.find(fault) == std::string::npos)
                variables.faults += "; " + fault;
    }
    return variables;
}

} // namespace

void requireAddressSpace() {
    // lavapipe waits forever for threads that have none.
    constexpr std::uint64_t neededBytes = std::uint64_t{256} << 20;
    if (const std::optional<std::uint64_t> left = addressSpaceLeft(); left && *left < neededBytes)
        throw Error(
            ErrorKind::LimitExceeded,
            fmt::format("a Vulkan driver takes {} of address space and more, and the limit leaves {}; "
                        "raise it (ulimit -v)",
                        sizeText(neededBytes), sizeText(*left)));
}

void explainDriverFiles(const std::function<void()> &callLoader) {
    try {
        callLoader();
    } catch (const Error &error) {
        const Variables variables = readVariables();
        if (variables.faults.empty() && (variables.values.empty() || error.kind != ErrorKind::NoDevice))
            throw;
        throw DeviceFault(ErrorKind::NoDevice, fmt::format("{}{}{}; correct or unset the variable",
                                                           error.what(), variables.values, variables.faults));
    }
}

} // namespace hyalite::core::gpu
