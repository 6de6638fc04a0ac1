// Contents of a glTF file: meshes, materials, lights and a camera, in world space.
#pragma once

#include "host/import/file_access.h"
#include "host/import/gltf/cameras.h"
#include "host/import/loaded_scene.h"
#include "host/import/mesh_file.h"
#include "host/import/texture_library.h"
#include "host/scene/scene.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core::gltf {

struct ContentOptions {
    std::string scene{};  ///< name or index; empty: the file's default one
    std::string camera{}; ///< likewise; empty: the first one
    std::optional<double> timeSeconds{};
    std::optional<SequenceTimes> sequence{};
    const OnReading &onReading;
};

struct Contents {
    GltfOutline outline{};
    MeshFile file; ///< names its buffers, too, in its report
    std::vector<Light> lights;
    std::optional<Image> environment{};   ///< radiance, as Environment has it
    std::vector<LightProfile> profiles{}; ///< of the lights
    std::optional<PlacedCamera> camera;
    CameraPath cameraPath{};                ///< of a sequence in which nothing else moves
    bool movesByTime = false;               ///< meshes or lights do
    std::optional<glm::dvec3> restOrigin{}; ///< where there are animations: that of the scene at rest
};

[[nodiscard]] Contents readContents(const std::filesystem::path &path, const FileAccess &access,
                                    TextureLibrary &textures, const ContentOptions &options);

} // namespace hyalite::core::gltf
