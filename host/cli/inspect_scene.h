// The contents of a scene, as `hyalite inspect` prints them: bounds, camera, lights, materials.
#pragma once

#include "host/render/prepare.h"

#include <filesystem>
#include <string>

namespace hyalite {

/// On standard output. Of lists at most 32 rows.
void printScene(const PreparedScene &prepared);

/// The cameras and nodes that a glTF file has, likewise; nothing for other files. `gltfScene` chooses one of its scenes.
void printOutline(const std::filesystem::path &file, const std::string &gltfScene);

} // namespace hyalite
