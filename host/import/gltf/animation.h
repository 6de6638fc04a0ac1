// Animations of a glTF file (glTF 2.0, section 3.11) at a point in time.
#pragma once

#include "host/import/gltf/buffers.h"
#include "host/import/gltf/nodes.h"

#include <vector>

namespace hyalite::core::gltf {

/// Moves the poses to where all animations of the file have them at that time: before its first key a channel has the
/// first value, behind the last one the last. Where two animations move the same member of a node, the first one
/// counts.
void animate(Buffers &buffers, double seconds, std::vector<Pose> &poses);

/// The nodes that an animation of the file moves, or whose meshes one deforms.
[[nodiscard]] std::vector<bool> animatedNodes(const Document &document);

} // namespace hyalite::core::gltf
