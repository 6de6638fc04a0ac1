// The contents of a scene, as `hyalite inspect` prints them: bounds, camera, lights, materials.
#pragma once

#include "host/engine/prepare.h"

namespace hyalite::core {

/// On standard output. Of lists at most 32 rows.
void printScene(const PreparedScene &prepared);

/// The cameras and nodes that a glTF file has.
void printOutline(const GltfOutline &outline);

} // namespace hyalite::core
