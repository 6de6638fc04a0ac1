// Formats: the registry of scene and mesh files. A row is an extension and its readers.
#pragma once

#include "host/import/loaded_scene.h"
#include "host/import/mesh_file.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace hyalite::core {

struct Format {
    std::string_view extension; ///< ".obj", in lower case
    /// Whether a file without a name, standard input, is of this format. The first row that says so is right.
    bool (*hasContent)(std::span<const char> bytes);
    /// Reads the file as a scene. Null: a file of meshes alone, which is framed and lit.
    LoadedScene (*readScene)(const std::filesystem::path &file, const LoadOptions &options) = nullptr;
    bool hasChoices = false; ///< of cameras, scenes and times: LoadOptions
    /// Reads its meshes and their materials, for a scene file that places them. Null: no scene file may.
    MeshFile (*readMeshes)(const std::filesystem::path &file, const MeshOptions &options) = nullptr;
};

[[nodiscard]] std::span<const Format> formats();

/// The format of the file's extension, in any letter case; null if none has it. That of standard input is by its
/// contents.
[[nodiscard]] const Format *formatOf(const std::filesystem::path &file);

/// ".json, .obj or .glb", for messages.
[[nodiscard]] std::string listOfExtensions();

} // namespace hyalite::core
