#include "host/gpu/vk/driver_environment.h"

#include "host/base/error.h"
#include "host/base/host_memory.h"
#include "host/base/json_document.h"
#include "host/base/quantities.h"
#include "host/gpu/vk/check.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include <dlfcn.h>

namespace hyalite::core::gpu {

namespace {

namespace fs = std::filesystem;

/// The fault of a driver's manifest
/// (https://github.com/KhronosGroup/Vulkan-Loader/blob/main/docs/LoaderDriverInterface.md), or empty.
std::string faultOf(const fs::path &manifest) {
    std::error_code error;
    if (!fs::exists(manifest, error))
        return fmt::format("there is no file {}", manifest.string());
    if (fs::is_directory(manifest, error)) // newer loaders look at the files in it
        return "";
    try {
        const nlohmann::json document = readJsonFile(manifest);
        const nlohmann::json::json_pointer place("/ICD/library_path");
        if (!document.contains(place) || !document[place].is_string())
            return fmt::format("{} has no /ICD/library_path, and is no driver's manifest", manifest.string());
        const fs::path name = document[place].get<std::string>();
        const fs::path library = name.has_parent_path() ? manifest.parent_path() / name : name;
        void *const handle = dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
        if (handle == nullptr)
            return fmt::format("the library that {} names cannot be loaded: {}", manifest.string(),
                               dlerror());
        dlclose(handle);
        return "";
    } catch (const Error &unreadable) {
        return unreadable.what();
    }
}

struct Variables {
    std::string values; ///< "; VK_DRIVER_FILES is /a.json:/b.json"
    std::string faults; ///< "; there is no file /a.json"
};

/// The variables that choose drivers, as far as they are set. Newer loaders do not look at the second one if the first
/// is set.
Variables readVariables() {
    Variables variables;
    for (const char *name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        const char *const value = std::getenv(name);
        if (value == nullptr || *value == '\0')
            continue;
        variables.values += fmt::format("; {} is {}", name, value);
        std::istringstream files(value);
        for (std::string file; std::getline(files, file, ':');)
            if (const std::string fault = file.empty() ? "" : faultOf(file);
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
