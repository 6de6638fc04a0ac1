// Fast path for OBJ: statements in the plainest form, which are nearly all of a file.
#pragma once

#include "host/import/obj_mesh.h"

#include <cstddef>

namespace hyalite {

/// Reads the statement at `line`, the beginning of a logical line, and gives a v, vn, vt or f to `builder`, which may
/// throw. Returns where the next line begins.
///
/// Returns null, with nothing consumed, for anything unusual: an indent, a comment, a continued line, a keyword of more
/// than two letters, an unexpected token, a face of more than 8 corners, or a zero, which must follow the last
/// character. Such lines go to checkStatement and tinyobjloader, which give the same bits for plain ones.
[[nodiscard]] const char *readPlainStatement(const char *line, std::size_t lineNumber,
                                             ObjMeshBuilder &builder);

} // namespace hyalite
