// A scene with all of its files as one JSON document, so that a tool can shrink it member by member.
//
//   { "scene": what hyalite-scene.schema.json describes,
//     "files": { NAME: by its extension,
//       .obj       an array of lines
//       .pfm       { "width", "height", "floats": three a pixel, from the bottom row up }
//       .png       { "width", "channels": 3 or 4, "levels": from the top row down }
//       .glb       { "materials", "textures", "samplers", "images": as in glTF;
//                    "primitives": [ { "material", "mode", "indices": [...], ATTRIBUTE: [ VECTOR ] } ] } } }
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

namespace hyalite::core::testing {

/// Writes scene.json and its files into the folder, which is made. Returns the path of scene.json. Throws an exception
/// of nlohmann::json if the document has another form.
std::filesystem::path writeDocument(const nlohmann::json &document, const std::filesystem::path &folder);

} // namespace hyalite::core::testing
