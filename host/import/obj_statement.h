// Grammar check of the supported OBJ statements. tinyobjloader parses everything accepted here correctly.
#pragma once

#include "host/import/obj_lines.h"

#include <cstddef>
#include <span>

namespace hyalite {

/// Corners of one face: bounds the time for a hostile polygon, which grows with their square, to seconds.
inline constexpr std::size_t maxFaceCorners = 65'536;

enum class ObjStatement {
    Geometry, ///< v, vn, vt or f
    Skipped,  ///< blank, comment, or about names, groups, materials
    Unused,   ///< anything else: l, p, free-form geometry, unknown keywords
};

/// What `statement` says, and, for Geometry, the part of it to pass on; begins at the keyword.
struct CheckedStatement {
    ObjStatement kind;
    std::span<char> text;
};

/// Checks and cleans one line; it is rewritten in place, and one character after its end is overwritten with
/// a line feed. The text to pass on has one of the forms
///
///     v  number number number     decimals that tinyobjloader's own parser neither overflows on nor loses
///     vn number number number     digits of; a vn that holds nan or inf has become 0 0 0
///     vt number number            or one number; likewise
///     f  corner corner corner...  corner = i | i/i | i//i | i/i/i, integers of 32 bits; v and vn not 0
///
/// separated by blanks or tabs. What follows the last of these numbers, or a # in the place of a token, is dropped, and
/// so are slashes at the end of a corner (tinyobjloader would look for their number in the next corner). Throws
/// Error{BadInput} through `lines` for all else: what was found, and what is allowed.
[[nodiscard]] CheckedStatement checkStatement(std::span<char> statement, const ObjLines &lines);

} // namespace hyalite
