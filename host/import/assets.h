// Where the shipped scenes are, and which file a SCENE argument means.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite {

/// The folders that hold shipped assets, first come first served: $HYALITE_ASSETS where it is set, then
/// ../share/hyalite beside the program's own folder. They need not exist.
[[nodiscard]] std::vector<std::filesystem::path> assetFolders();

/// The names of the shipped scenes, that is of scenes/NAME.json in any asset folder, sorted.
[[nodiscard]] std::vector<std::string> availableScenes();

/// The file that a SCENE argument means: an argument that ends in .json or .obj is a path (and may not exist), a
/// bare word is a shipped scene's name. Throws Error{BadInput}, for an unknown name with the places looked at
/// and the names that exist.
[[nodiscard]] std::filesystem::path resolveScene(const std::string &argument);

/// Does the file's name end in `extension` (".obj", in lower case), whatever its case?
[[nodiscard]] bool hasExtension(const std::filesystem::path &file, std::string_view extension);

} // namespace hyalite
