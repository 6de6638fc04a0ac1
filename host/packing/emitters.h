// Emitter table for next-event estimation: the emitters and their selection probabilities.
#pragma once

#include "host/packing/packed_scene.h"

namespace hyalite::core {

/// The emitter kind of a light: layout::emitter...
[[nodiscard]] std::uint32_t emitterKindOf(const layout::LightRecord &light);

/// Adds the emitters of `scene` to `packed` in the order of the input, with the environment last if `isLitAround`;
/// `choice` says whether they get a light tree. Their selection probabilities are proportional to their power. The
/// environment and directional lights have no power; each counts as much as all finite emitters together. Sets the
/// resulting pdfs of the materials. The triangles must be packed.
void packEmitters(const Scene &scene, bool isLitAround, LightChoice choice, PackedScene &packed);

} // namespace hyalite::core
