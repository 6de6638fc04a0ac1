// Preparation: from a scene file and its overrides to the packed scene.
#pragma once

#include "host/base/error.h"
#include "host/bvh/bvh.h"
#include "host/engine/observer.h"
#include "host/film/film.h"
#include "host/import/loaded_scene.h"
#include "host/import/scene_document.h"
#include "host/packing/packed_scene.h"
#include "host/report/provenance.h"
#include "host/scene/framing.h"
#include "host/scene/instances.h"
#include "host/scene/light_sources.h"
#include "host/scene/settings_table.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core {

/// Overrides: the command line beats the scene file, which beats defaults. Only given values are set.
struct SceneOptions {
    std::string scene;
    std::shared_ptr<const SceneDocument> document{}; ///< a scene in memory, instead of `scene`
    std::optional<int> width;
    std::optional<int> height;
    std::optional<double> sizeShare{}; ///< in (0, 1]: of both sides, after these, and of the crop
    SettingChanges settings;
    std::vector<Integrator> views{}; ///< rendered as layers, too: settings that they use have an effect
    std::optional<double> fovDegrees;
    std::optional<double> aperture{};
    std::optional<double> focusDistance{};
    std::optional<double> viewWidth{};
    std::vector<double> cameraPosition;
    std::vector<double> lookAt;
    std::vector<double> up;
    std::vector<double> background;
    std::string environment; ///< a file, or neutralEnvironmentName; empty: the scene's own
    std::optional<double> environmentScale;
    std::optional<double> environmentRotateDegrees;
    std::vector<int> crop;
    LoadOptions load;            ///< its events are set by prepareScene
    bool isFlattened = false;    ///< all instances become meshes, whatever memory they take
    bool keepsInstances = false; ///< none do, but those that have to; without either, those that fit
};

/// An override that conflicts with the scene or with another one. `name` is that of the override: "crop", "look-at".
class OverrideError : public Error {
  public:
    OverrideError(std::string overrideName, const std::string &message, Remedy mayHelp = Remedy::None)
        : Error(ErrorKind::Usage, message, mayHelp), name(std::move(overrideName)) {}

    const std::string name;
};

/// Whether meshes and tree are kept after packing. Renderers read only the packed scene; for a large mesh the rest is a
/// sixth of the memory. Glass is kept in any case: what is around a camera that moves is asked of it.
enum class Source { Kept, Dropped };

/// A scene ready for both renderers.
struct PreparedScene {
    LoadedScene loaded; ///< its scene without meshes, but those of glass, if the source was dropped
    Arrangement arrangement;
    Bvh bvh; ///< empty if the source was dropped
    PackedScene packed;
    std::uint64_t arraysHash = 0; ///< of `packed`
    Crop crop;
    LightSources sources;
    std::optional<Bounds> framed{};   ///< what the camera sees, where the file has none
    Camera givenCamera;               ///< as the scene has it, without overrides
    std::vector<Light> givenLights{}; ///< likewise, where they are those of a framed mesh
    RenderSettings givenSettings;     ///< likewise
    std::vector<Integrator> views{};  ///< to be rendered as layers: what was asked for, and what alpha needs
    double loadSeconds = 0.0;
    double buildSeconds = 0.0;

    /// packed.contentHash()
    [[nodiscard]] std::uint64_t contentHash() const { return packed.contentHash(arraysHash); }
};

/// Loads, overrides, validates, builds and packs. Throws Error{BadInput}, or OverrideError for conflicting overrides,
/// such as a crop outside the image. The observer gets the task "load", warnings of what is lost, and advice on light
/// that the integrator does not see. `onOutline` gets an outline of the scene, with overrides applied, before large
/// files are read.
[[nodiscard]] PreparedScene prepareScene(const SceneOptions &options, Source source, Observer &observer,
                                         const std::function<void(const SceneOutline &)> &onOutline = {});

/// Tells what was lost when the scene was loaded.
void tellWarnings(const LoadedScene &loaded, Observer &observer);

/// Whether two scenes that are prepared with these options differ only in what changeView() changes. `prepared` is the
/// first one.
[[nodiscard]] bool isOtherView(const PreparedScene &prepared, const SceneOptions &options,
                               const SceneOptions &others);

/// Gives the scene the camera, the picture's size, the crop and the settings that it has with `options`, of which
/// isOtherView() said so. Throws as prepareScene() does, and leaves the scene as one that can be changed again.
void changeView(PreparedScene &prepared, const SceneOptions &options);

/// Provenance for reports.
[[nodiscard]] Provenance provenanceOf(const PreparedScene &scene, const std::string &commandLine);

} // namespace hyalite::core
