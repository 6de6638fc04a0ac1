// EXT_mesh_gpu_instancing: a node whose mesh is seen in many places.
#pragma once

#include "host/import/gltf/buffers.h"

#include <glm/mat4x3.hpp>

#include <vector>

namespace hyalite::core::gltf {

/// The maps from the mesh to the node's space. Throws Error{BadInput} for attributes of different counts.
[[nodiscard]] std::vector<glm::dmat4x3> readInstancing(Buffers &buffers, const JsonObject &extension);

} // namespace hyalite::core::gltf
