// The environment map in the layout that the kernels read.
#pragma once

#include "host/packing/packed_scene.h"

namespace hyalite::core {

/// Appends the environment of `scene`, which has one, to packed.lookups, and describes it in packed.frame. Returns
/// whether any of it emits light, so that it can be sampled.
bool packEnvironment(const Scene &scene, PackedScene &packed);

} // namespace hyalite::core
