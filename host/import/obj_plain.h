// The short way of reading OBJ: statements in the plainest form, which are nearly all of a file.
#pragma once

#include "host/import/obj_mesh.h"

#include <cstddef>

namespace hyalite {

/// Reads the statement at `line`, the beginning of a logical line, and gives a v, vn, vt or f to `builder`, which may
/// throw. Returns where the next line begins.
///
/// Null, with nothing taken or given, wherever anything is out of the ordinary: an indent, a comment, a continued
/// line, a keyword of more than two letters, a token that is not what it should be, a face of more than 8 corners, a
/// zero, which must stand behind the last character. Such lines are for checkStatement and tinyobjloader; plain
/// ones give the same bits there.
[[nodiscard]] const char *readPlainStatement(const char *line, std::size_t lineNumber,
                                             ObjMeshBuilder &builder);

} // namespace hyalite
