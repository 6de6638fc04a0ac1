// The grammar of OBJ statements, of plain ones for the mesh builder and of all others in front of tinyobjloader.
#pragma once

#include "host/import/mesh_builder.h"
#include "host/import/obj_lines.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace hyalite::core {

/// Corners of one face: bounds the time for a hostile polygon, which grows with their square, to seconds.
inline constexpr std::size_t maxFaceCorners = 65'536;

/// Reads the statement at `line`, the beginning of a logical line, and gives a v, vn, vt or f to `builder`, which may
/// throw. Returns where the next line begins.
///
/// Returns null, with nothing consumed, for anything but the plainest form, which nearly all statements have: an
/// indent, a comment, a continued line, a keyword of more than two letters, an unexpected token, a face of more than 8
/// corners, or a zero, which must follow the last character. Such lines go to checkStatement and tinyobjloader, which
/// give the same bits for plain ones.
[[nodiscard]] const char *readPlainStatement(const char *line, std::size_t lineNumber, MeshBuilder &builder);

/// A v, vn, vt or f for tinyobjloader.
struct CheckedStatement {
    std::span<char> text{};            ///< ends in a line feed; empty: there is nothing to pass on
    std::optional<glm::vec3> colour{}; ///< of a v
};

/// Checks and cleans one line in place, whose keyword is in small letters; the character after its end becomes a line
/// feed. The text to pass on has one of these forms, separated by blanks or tabs:
///
///     v  number number number     decimals that the parser of tinyobjloader reads without overflow or lost digits
///     vn number number number
///     vt number number            or one number
///     f  corner corner corner...  corner = i | i/i | i//i | i/i/i, integers of 32 bits; v and vn not 0
///
/// Everything after the last of these numbers, or from a # in the place of a token, is dropped. So are slashes at the
/// end of a corner, because tinyobjloader would look for their number in the next corner. A v, vn or vt with nan or inf
/// and a face of fewer than three corners go to `builder`; so does the loss of a statement that is not read. Throws
/// Error{BadInput} through `lines` for anything else, with what was found and what is allowed.
[[nodiscard]] CheckedStatement checkStatement(std::span<char> statement, const ObjLines &lines,
                                              MeshBuilder &builder);

} // namespace hyalite::core
