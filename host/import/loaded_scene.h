// A loaded scene: what every reader of scenes takes and gives, whatever the format.
#pragma once

#include "host/import/gltf/outline.h"
#include "host/import/mesh_file.h"
#include "host/scene/camera_path.h"
#include "host/scene/scene.h"
#include "host/scene/settings.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// The facts about a scene that are known before its large files are read.
struct SceneOutline {
    bool hasMeshes;
    RenderSettings settings;
};

/// Callbacks while a scene is loaded.
struct LoadEvents {
    std::function<void(const SceneOutline &)> onOutline{};
    OnReading onReading{}; ///< the share of all meshes that is read, each counting the same
};

inline constexpr double defaultFramesPerSecond = 24.0;

/// Frames of a sequence in time.
struct SequenceTimes {
    std::optional<double> framesPerSecond{}; ///< default: defaultFramesPerSecond
    int firstFrame = 0;                      ///< nobody asks for those before it
    int lastFrame = 0;
    bool isOfClip = false; ///< which has the rate, too: formats without animations do not refuse one

    /// In seconds.
    [[nodiscard]] double timeOf(int frame) const {
        return frame / framesPerSecond.value_or(defaultFramesPerSecond);
    }
};

/// How a scene is loaded.
struct LoadOptions {
    LoadEvents events{};
    std::vector<std::filesystem::path> allowedPaths{}; ///< files that a scene may name beside those near it
    // Formats that have a choice, as glTF does; others refuse them.
    std::string camera{};                    ///< name or index; empty: the first one
    std::string gltfScene{};                 ///< name or index; empty: the file's default one
    std::optional<double> timeSeconds{};     ///< of animations; empty: the pose of rest
    std::optional<SequenceTimes> sequence{}; ///< that wants the camera's path; its rate is a choice
};

struct LoadedScene {
    Scene scene;
    RenderSettings settings;
    CameraPath cameraPath{};                ///< of its camera
    std::optional<glm::dvec3> restOrigin{}; ///< of a file with animations: its origin at all times (origin.h)
    bool movesByTime = false; ///< other frames of a sequence show other meshes or lights: load it for each
    std::filesystem::path file;
    std::vector<std::string> inputFiles;  ///< all that were read, this one and those that it names
    std::optional<GltfOutline> outline{}; ///< of a glTF file
    std::vector<std::string> warnings;    ///< of what is not a mesh
    std::vector<MeshReport> meshReports;  ///< one for each mesh of the input
    /// Of the camera, where the file gives this one: the horizontal one follows from the size of the image.
    std::optional<double> verticalFovDegrees{};
    std::optional<double> aspectRatio{}; ///< width / height of the image, where the file gives its camera one
    std::optional<glm::dvec3> worldUp{}; ///< of formats that know it; else the camera's own counts
    /// No camera in the file: where the image size is overridden, call frameCamera again.
    bool autoFramed = false;
    bool isAutoLit = false; ///< no lights in the file: where the camera is overridden, call frameLights
};

} // namespace hyalite::core
