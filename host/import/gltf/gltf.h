// glTF 2.0: .gltf and .glb as scenes, and as meshes for scene files. assets/README.md says what is read.
#pragma once

#include "host/import/loaded_scene.h"
#include "host/import/mesh_file.h"

#include <filesystem>

namespace hyalite::core {

/// Reads a scene of the file with its camera and lights, for the integrator `path`. Without a camera one is placed that
/// sees all of it; without lights there is the neutral environment. Memory stays in proportion to the files
/// (gltf/memory_budget.h). Throws Error{BadInput}, "FILE: /path/in/the/json: ...", for malformed files, and
/// Error{Usage} for a camera or a scene that the file does not have.
[[nodiscard]] LoadedScene loadGltf(const std::filesystem::path &file, const LoadOptions &options);

/// The meshes of the file's default scene and their materials. Cameras and lights are left out with a warning.
[[nodiscard]] MeshFile readGltfMeshes(const std::filesystem::path &file, const MeshOptions &options);

} // namespace hyalite::core
