// What the path integrator aims at, and how often.
#pragma once

#include "host/bvh/packed_scene.h"

namespace hyalite {

/// Lists the emitters of `scene` in the packed one, in the order of the input, each with a probability that goes with its
/// power, and tells the materials the densities that follow from it. The triangles are packed.
void packEmitters(const Scene &scene, PackedScene &packed);

} // namespace hyalite
