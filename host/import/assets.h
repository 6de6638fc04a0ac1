// Shipped assets: their folders, and the file of a SCENE argument.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Asset folders in search order: $HYALITE_ASSETS if set, then share/hyalite of the installation that this code is
/// from, as a program, a shared library or a module. They need not exist.
[[nodiscard]] std::vector<std::filesystem::path> assetFolders();

/// The file of this path, such as "verify/films.json", in the first asset folder that has it. Throws Error{BadInput}.
[[nodiscard]] std::filesystem::path shippedFile(const std::filesystem::path &path);

/// The sorted names of the shipped scenes: scenes/NAME.json or scenes/NAME.glb in any asset folder.
[[nodiscard]] std::vector<std::string> availableScenes();

/// The file of a SCENE argument. An argument with the extension of a format (formats.h) is a path, which need not
/// exist; a bare word is the name of a shipped scene. Throws Error{BadInput} for an unknown name, with the folders
/// searched and the names that exist, and for a file of a format that is not read (foreign_format.h).
[[nodiscard]] std::filesystem::path resolveScene(const std::string &argument);

/// Whether the file name ends in `extension` (".obj", in lower case), ignoring case.
[[nodiscard]] bool hasExtension(const std::filesystem::path &file, std::string_view extension);

} // namespace hyalite::core
