#include "host/gpu/vk/driver_manifests.h"

#include "host/base/error.h"
#include "host/base/json_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <system_error>

#include <dlfcn.h>

namespace hyalite::core::gpu {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> partsOf(const std::string &list) {
    std::vector<fs::path> parts;
    std::istringstream stream(list);
    for (std::string part; std::getline(stream, part, ':');)
        if (!part.empty())
            parts.emplace_back(part);
    return parts;
}

std::string valueOf(const char *variable) {
    const char *const value = std::getenv(variable);
    return value != nullptr ? value : "";
}

/// `variable` names a folder of the user; without it, it is `usual` in the home folder.
std::vector<fs::path> usersFolder(const char *variable, const char *usual) {
    if (const std::string value = valueOf(variable); !value.empty())
        return {value};
    const std::string home = valueOf("HOME");
    return home.empty() ? std::vector<fs::path>() : std::vector{fs::path(home) / usual};
}

std::vector<fs::path> systemFolders(const char *variable, const char *usual) {
    const std::string value = valueOf(variable);
    return partsOf(value.empty() ? usual : value);
}

} // namespace

std::vector<fs::path> DriverVariable::files() const { return partsOf(value); }

std::vector<DriverVariable> driverVariables() {
    std::vector<DriverVariable> variables;
    for (const char *name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"})
        if (std::string value = valueOf(name); !value.empty())
            variables.push_back({name, std::move(value)});
    return variables;
}

std::vector<fs::path> manifestFolders() {
    std::vector<fs::path> folders;
    for (const std::vector<fs::path> &parents :
         {usersFolder("XDG_CONFIG_HOME", ".config"), systemFolders("XDG_CONFIG_DIRS", "/etc/xdg"),
          std::vector{fs::path("/etc")}, usersFolder("XDG_DATA_HOME", ".local/share"),
          systemFolders("XDG_DATA_DIRS", "/usr/local/share:/usr/share")})
        for (const fs::path &parent : parents)
            folders.push_back(parent / "vulkan/icd.d");
    return folders;
}

std::vector<fs::path> manifestsIn(const std::vector<fs::path> &folders) {
    std::vector<fs::path> manifests;
    for (const fs::path &folder : folders) {
        std::vector<fs::path> files;
        std::error_code error; // a folder that is missing or may not be read holds none
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
            if (entry->path().extension() == ".json")
                files.push_back(entry->path());
        std::ranges::sort(files);
        manifests.insert(manifests.end(), files.begin(), files.end());
    }
    return manifests;
}

std::vector<fs::path> driverManifests() {
    const std::vector<DriverVariable> variables = driverVariables();
    std::vector<fs::path> manifests;
    for (const fs::path &file :
         variables.empty() ? partsOf(valueOf("VK_ADD_DRIVER_FILES")) : variables.front().files()) {
        std::error_code error;
        if (!fs::is_directory(file, error)) // newer loaders look at the files in it
            manifests.push_back(file);
        else
            for (const fs::path &inside : manifestsIn({file}))
                manifests.push_back(inside);
    }
    if (variables.empty())
        std::ranges::copy(manifestsIn(manifestFolders()), std::back_inserter(manifests));
    return manifests;
}

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

} // namespace hyalite::core::gpu
