// Fast path for OBJ: statements in the plainest form, which are nearly all of a file.
#pragma once

#include "host/import/mesh_builder.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>

namespace hyalite {

/// Reads the statement at `line`, the beginning of a logical line, and gives a v, vn, vt or f to `builder`, which may
/// throw. Returns where the next line begins.
///
/// Returns null, with nothing consumed, for anything unusual: an indent, a comment, a continued line, a keyword of more
/// than two letters, an unexpected token, a face of more than 8 corners, or a zero, which must follow the last
/// character. Such lines go to checkStatement and tinyobjloader, which give the same bits for plain ones.
[[nodiscard]] const char *readPlainStatement(const char *line, std::size_t lineNumber, MeshBuilder &builder);

/// The colour behind the coordinates of a v, which begins at `at` and ends before the line end: three numbers, or the
/// weight and three numbers. As in files of Blender and MeshLab they are sRGB in [0, 1]; the result is linear. Empty
/// for anything else.
[[nodiscard]] std::optional<glm::vec3> readVertexColour(const char *at);

} // namespace hyalite
