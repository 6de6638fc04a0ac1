// Transforms of scene files: a matrix, or a list of steps.
#pragma once

#include "host/base/json_reader.h"
#include "host/import/mesh_file.h"
#include "host/scene/scene.h"

#include <glm/mat4x3.hpp>

namespace hyalite::core {

/// Reads an affine map from object space to world space. The value is an array: of 12 numbers, the rows of a matrix of
/// three rows and four columns, or 16 of which the last four are 0, 0, 0, 1; or of steps, applied in their order, each
/// an object with one key: `scale` (a number or three), `rotateDegrees` (about x, then y, then z), `translate`,
/// `matrix`. Throws Error{BadInput} for anything else, and for a map that flattens space in single precision.
[[nodiscard]] glm::dmat4x3 readTransform(const JsonNode &node);

/// The steps of a mesh file's transform as a map.
[[nodiscard]] glm::dmat4x3 mapOf(const MeshTransform &transform);

/// `inner` first, then `outer`.
[[nodiscard]] glm::dmat4x3 composed(const glm::dmat4x3 &outer, const glm::dmat4x3 &inner);

/// The map in single precision.
[[nodiscard]] Placement toPlacement(const glm::dmat4x3 &transform);

} // namespace hyalite::core
