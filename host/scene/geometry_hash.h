// Geometry hash: of all meshes and their places.
#pragma once

#include "host/scene/scene.h"

#include <cstdint>

namespace hyalite::core {

/// Hash of meshes, prototypes and instances, but for their names and nodes. Of a scene before its instances are arranged
/// (instances.h), so that it does not depend on how many become meshes. The same on every machine.
[[nodiscard]] std::uint64_t geometryHash(const Scene &scene);

} // namespace hyalite::core
