// The scene file: JSON in, Scene out. assets/README.md describes it for people, assets/hyalite-scene.schema.json for
// editors.
#pragma once

#include "host/import/loaded_scene.h"
#include "host/import/scene_document.h"
#include "host/scene/scene.h"
#include "host/scene/settings_table.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Reads a scene file and the meshes that it names. Values are in range and names are defined; what concerns
/// several values at once (is up parallel to the view?) is left to validateScene. Files outside of the scene's
/// folder, the assets and `options.allowedPaths` are not read (file_access.h). Throws Error{BadInput}
/// naming the file, the key as a JSON path such as /spheres/3/radius (a syntax error: line and column), what
/// was found and what is allowed.
[[nodiscard]] LoadedScene loadSceneFile(const std::filesystem::path &file, const LoadOptions &options = {});

/// The same for a document in memory, whose faults have no lines.
[[nodiscard]] LoadedScene loadSceneDocument(const SceneDocument &document, const LoadOptions &options = {});

/// The keys of each object of a scene file.
namespace scene_keys {

inline constexpr auto top =
    std::to_array<std::string_view>({"$schema", "description", "camera", "background", "environment",
                                     "lights", "materials", "spheres", "shapes", "meshes", "settings"});
inline constexpr auto environment =
    std::to_array<std::string_view>({"file", "scale", "rotateDegrees", "lightGroup"});
inline constexpr auto camera =
    std::to_array<std::string_view>({"type", "position", "target", "direction", "up", "horizontalFov",
                                     "aperture", "focusDistance", "viewWidth", "width", "height", "path"});
inline constexpr auto cameraPath = std::to_array<std::string_view>({"interpolation", "keys"});
inline constexpr auto cameraKey =
    std::to_array<std::string_view>({"frame", "position", "target", "direction", "up", "horizontalFov",
                                     "aperture", "focusDistance", "viewWidth"});
inline constexpr auto pointLight = std::to_array<std::string_view>(
    {"type", "position", "power", "profile", "direction", "c0", "lightGroup"});
inline constexpr auto spotLight = std::to_array<std::string_view>(
    {"type", "position", "power", "direction", "angle", "blend", "fade", "profile", "c0", "lightGroup"});
inline constexpr auto directionalLight =
    std::to_array<std::string_view>({"type", "direction", "irradiance", "lightGroup"});
inline constexpr auto texture = std::to_array<std::string_view>({"file", "scale", "offset"});
inline constexpr auto normalMap = std::to_array<std::string_view>({"file", "scale", "offset", "strength"});
inline constexpr auto sphere =
    std::to_array<std::string_view>({"centre", "radius", "material", "inwardNormal"});
inline constexpr auto mesh =
    std::to_array<std::string_view>({"file", "scale", "rotateDegrees", "translate", "transform", "material",
                                     "materialOverrides", "instances"});
inline constexpr auto shape =
    std::to_array<std::string_view>({"type", "segments", "material", "transform", "instances"});
/// Those of the table of settings, and one that is the scene's.
inline constexpr auto settings = [] {
    std::array<std::string_view, settingsTable.size() + 1> keys;
    std::ranges::transform(settingsTable, keys.begin(), &Setting::key);
    keys.back() = "shadowThroughGlass";
    return keys;
}();

/// Of a material of that kind, and of its textures.
[[nodiscard]] std::vector<std::string_view> material(const MaterialRow &row);
[[nodiscard]] std::vector<std::string_view> textures(const MaterialRow &row);

} // namespace scene_keys
} // namespace hyalite::core
