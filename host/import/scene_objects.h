// Spheres, shapes and meshes of scene files.
#pragma once

#include "host/base/json_reader.h"
#include "host/import/file_access.h"
#include "host/import/scene_json.h"
#include "host/import/texture_library.h"

namespace hyalite::core {

/// Reads the spheres, shapes and meshes of the scene file whose materials `loaded` has, in this order, and the files of
/// the meshes. `onReading` gets the share of the meshes that is read. Faults of single objects are
/// kept in `faults`.
void readObjects(const JsonObject &top, const FileAccess &access, TextureLibrary &textures,
                 const OnReading &onReading, JsonFaults &faults, LoadedScene &loaded);

} // namespace hyalite::core
