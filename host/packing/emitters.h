// Emitter table for next-event estimation: the emitters and their selection probabilities.
#pragma once

#include "host/packing/packed_scene.h"

namespace hyalite {

/// What the path integrator calls a light of this kind: layout::emitter...
[[nodiscard]] std::uint32_t emitterKindOf(const layout::LightRecord &light);

/// Lists the emitters of `scene` in the packed one, in the order of the input, the environment last where
/// `isLitAround`, each with a probability that goes with its power, and tells the materials the densities that follow
/// from it. The environment and directional lights, which have no power, count as much as all others together, each.
/// The triangles are packed.
void packEmitters(const Scene &scene, bool isLitAround, PackedScene &packed);

} // namespace hyalite
