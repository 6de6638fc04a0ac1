// Driver manifests: the JSON files by which the Vulkan loader finds drivers ("ICD files").
//
// https://github.com/KhronosGroup/Vulkan-Loader/blob/main/docs/LoaderDriverInterface.md
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::gpu {

/// The variables that name drivers' files instead of folders, as far as they are set. Loaders from 1.3.207 on do not look
/// at VK_ICD_FILENAMES if VK_DRIVER_FILES is set.
struct DriverVariable {
    std::string_view name;
    std::string value;
    [[nodiscard]] std::vector<std::filesystem::path> files() const; ///< those between its colons
};
[[nodiscard]] std::vector<DriverVariable> driverVariables();

/// The folders that the loader searches where no variable names files, in its order, present or not.
[[nodiscard]] std::vector<std::filesystem::path> manifestFolders();

/// The manifests in these folders, folder by folder, by their names.
[[nodiscard]] std::vector<std::filesystem::path>
manifestsIn(const std::vector<std::filesystem::path> &folders);

/// The manifests that the loader reads: those that a variable names, or else those in its folders and those that
/// VK_ADD_DRIVER_FILES adds.
[[nodiscard]] std::vector<std::filesystem::path> driverManifests();

/// The fault of a manifest, with its name, or empty: it is missing, unreadable, or names a library that does not load.
/// Loads the library, and lets it go.
[[nodiscard]] std::string faultOf(const std::filesystem::path &manifest);

} // namespace hyalite::core::gpu
