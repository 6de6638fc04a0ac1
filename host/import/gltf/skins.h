// Skins of a glTF file (glTF 2.0, section 3.7.3): the maps that bring vertices to where joints are.
#pragma once

#include "host/import/gltf/buffers.h"

#include <glm/mat4x3.hpp>

#include <cstddef>
#include <vector>

namespace hyalite::core::gltf {

/// Of each joint of a skin, the map from the space of the mesh, bound to the skeleton, to the world. `toWorld` are the
/// maps of all nodes.
[[nodiscard]] std::vector<glm::dmat4x3> jointMaps(Buffers &buffers, std::size_t skin,
                                                  const std::vector<glm::dmat4x3> &toWorld);

} // namespace hyalite::core::gltf
