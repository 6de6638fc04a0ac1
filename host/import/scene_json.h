// The scene file: JSON in, Scene out. assets/hyalite-scene.schema.json says the same to editors.
//
//   {
//     "$schema", "description"  texts, ignored
//     "background"   colour, default black: radiance of rays that leave the scene
//     "environment": {        instead of the background
//       "file"           .hdr, .exr or .pfm, by longitude and latitude: the middle is -z, the top +y; of at most 2^22 pixels
//       "scale"          factor, default 1
//       "rotateDegrees"  about +y, default 0
//     },
//     "camera": {
//       "type"           "perspective" (default), "orthographic" or "panorama"
//       "position"       point, default [0, 0, 55]
//       "target"         point to look at, or
//       "direction"      vector of view, default [0, 0, -1]
//       "up"             vector, default [0, 1, 0]; not parallel to the view
//       "horizontalFov"  degrees in (0, 180), default 60; perspective only, and so
//       "aperture"       diameter of a thin lens, default 0: a pinhole
//       "focusDistance"  of the plane that is sharp, default: that of the target, or 10
//       "viewWidth"      what the image's width shows, default 10; orthographic only
//       "width", "height"  pixels from 1 to 32768, default 512
//     },
//     "lights": [             at most 16, each one of
//       { "type": "point", "position": point,
//                          "power": colour; the radiant intensity is power / (4 pi) }
//       { "type": "spot", "position", "power": likewise, with the intensity on its axis;
//                         "direction": vector, default [0, -1, 0];
//                         "angle": degrees from the axis to the dark, in (0, 180], default 30;
//                         "blend": share of the angle in which it fades, from 0 to 1, default 0.2 }
//       { "type": "directional", "direction": vector, default [0, -1, 0]: in which the light travels;
//                                "irradiance": colour, of a surface that faces it }
//     ],
//     "materials": { NAME: one of
//       { "type": a row of materialTable (material.h), and its keys; "textures": where it wears any,
//          { "baseColour": IMAGE, a factor on the albedo or base colour, which then is 1 by default,
//            "emission": IMAGE, likewise, and so "roughness" and "metallic": of their red channel;
//            "normal": IMAGE in the space of the surface, with "strength", from 0 to 100, default 1;
//            "opacity": IMAGE, of its alpha, or of its red channel where it has none: below a half nothing is there;
//                       meshes only } }
//       IMAGE: { "file": PNG or JPEG, or .hdr for an emission; relative to the scene file as meshes are,
//                "scale": [u, v] or one number, default 1: how often it repeats, and "offset", default 0: it shows at (u, v)
//                         what it has at scale * (u, v) + offset }
//     },
//     "spheres": [ {
//       "centre"         point
//       "radius"         more than 0
//       "material"       NAME
//       "inwardNormal"   true: the normal points to the centre, default false
//     } ],
//     "meshes": [ {
//       "file"           a format of meshes (formats.h), relative to the scene file, and in its folder or below, or in the
//                        assets
//       "material"       NAME; without it the mesh has those that its own libraries (MTL) give it
//       "scale"          not 0, default 1; then
//       "rotateDegrees"  about x, y and z in that order, default [0, 0, 0]; then
//       "translate"      vector, default [0, 0, 0]; then
//       "transform"      TRANSFORM (transform_json.h)
//       "materialOverrides"  { NAME in the mesh's libraries: NAME }, where there is no "material"
//       "instances"      [ TRANSFORM ], at least one: the places of the mesh
//     } ],
//     "shapes": [ {
//       "type"           "quad", "box", "disk" or "cylinder" (host/scene/shapes.h)
//       "segments"       corners of a disk or a cylinder, from 3 to 4096, default 64
//       "material"       NAME
//       "transform"      TRANSFORM
//       "instances"      [ TRANSFORM ], at least one
//     } ],
//     "settings": {
//       each row of settingsTable (settings_table.h) by its key, and
//       "shadowThroughGlass"  factor on light that comes through glass alone, in [0, 1], default 1
//     }
//   }
//
// Points and vectors are [x, y, z]; a colour is linear [r, g, b], or one number for grey. A key without a
// default is required where its object is given; every object of the top level may be left out.
#pragma once

#include "host/import/loaded_scene.h"
#include "host/scene/scene.h"
#include "host/scene/settings_table.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace hyalite {

/// Reads a scene file and the meshes that it names. Values are in range and names are defined; what concerns
/// several values at once (is up parallel to the view?) is left to validateScene. Files outside of the scene's
/// folder, the assets and `options.allowedPaths` are not read (file_access.h). Throws Error{BadInput}
/// naming the file, the key as a JSON path such as /spheres/3/radius (a syntax error: line and column), what
/// was found and what is allowed.
[[nodiscard]] LoadedScene loadSceneFile(const std::filesystem::path &file, const LoadOptions &options = {});

/// The keys of each object of a scene file.
namespace scene_keys {

inline constexpr auto top =
    std::to_array<std::string_view>({"$schema", "description", "camera", "background", "environment",
                                     "lights", "materials", "spheres", "shapes", "meshes", "settings"});
inline constexpr auto environment = std::to_array<std::string_view>({"file", "scale", "rotateDegrees"});
inline constexpr auto camera =
    std::to_array<std::string_view>({"type", "position", "target", "direction", "up", "horizontalFov",
                                     "aperture", "focusDistance", "viewWidth", "width", "height", "path"});
inline constexpr auto cameraPath = std::to_array<std::string_view>({"interpolation", "keys"});
inline constexpr auto cameraKey =
    std::to_array<std::string_view>({"frame", "position", "target", "direction", "up", "horizontalFov",
                                     "aperture", "focusDistance", "viewWidth"});
inline constexpr auto pointLight = std::to_array<std::string_view>({"type", "position", "power"});
inline constexpr auto spotLight =
    std::to_array<std::string_view>({"type", "position", "power", "direction", "angle", "blend", "fade"});
inline constexpr auto directionalLight = std::to_array<std::string_view>({"type", "direction", "irradiance"});
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
} // namespace hyalite
