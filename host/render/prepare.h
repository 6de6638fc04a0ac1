// From a scene and what overrides it to what both renderers read.
#pragma once

#include "host/base/error.h"
#include "host/bvh/bvh.h"
#include "host/film/film.h"
#include "host/import/scene_json.h"
#include "host/packing/packed_scene.h"
#include "host/report/provenance.h"
#include "host/scene/settings_table.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite {

/// Command line beats scene file beats defaults: only what was given is set.
struct SceneOptions {
    std::string scene;
    std::optional<int> width;
    std::optional<int> height;
    SettingChanges settings;
    std::optional<double> fovDegrees;
    std::vector<double> cameraPosition;
    std::vector<double> lookAt;
    std::vector<double> up;
    std::vector<double> background;
    std::vector<int> crop;
    std::vector<std::filesystem::path> allowedPaths;
};

/// An override that does not go together with the scene or the others; `name` is its own: "crop", "look-at".
class OverrideError : public Error {
  public:
    OverrideError(std::string overrideName, const std::string &message)
        : Error(ErrorKind::Usage, message), name(std::move(overrideName)) {}

    const std::string name;
};

/// What becomes of a scene's meshes and tree once they are packed. Renderers read the packed scene alone; of a large
/// mesh the rest takes a sixth of the memory.
enum class Source { Kept, Dropped };

/// A scene made ready for both renderers.
struct PreparedScene {
    LoadedScene loaded; ///< its scene without meshes if the source was dropped
    Bvh bvh;            ///< empty if the source was dropped
    PackedScene packed;
    Crop crop;
    double loadSeconds = 0.0;
    double buildSeconds = 0.0;
};

/// Loads, overrides, validates, builds and packs. Throws Error{BadInput}, or OverrideError for overrides that do not go
/// together, such as a crop outside of the image. Shows the progress of reading large meshes, unless quiet. `onOutline`
/// is told of the scene, as the options make it, before large files are read.
[[nodiscard]] PreparedScene prepareScene(const SceneOptions &options, Source source, bool isQuiet,
                                         const std::function<void(const SceneOutline &)> &onOutline = {});

/// What reports say of it.
[[nodiscard]] Provenance provenanceOf(const PreparedScene &scene, const std::string &commandLine);

} // namespace hyalite
