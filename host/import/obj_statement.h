// Grammar check of the supported OBJ statements. tinyobjloader parses everything accepted here correctly.
#pragma once

#include "host/import/obj_lines.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace hyalite {

/// Corners of one face: bounds the time for a hostile polygon, which grows with their square, to seconds.
inline constexpr std::size_t maxFaceCorners = 65'536;

enum class ObjStatement {
    Geometry,  ///< v, vn, vt or f
    Skipped,   ///< blank, comment, or about names, groups, materials, levels of detail
    SmallFace, ///< an f of fewer than three corners
    Unused,    ///< anything else: l, p, free-form geometry, unknown keywords
};

/// The kind of a statement and, for Geometry, the part to pass on, from its keyword.
struct CheckedStatement {
    ObjStatement kind;
    std::span<char> text;
    std::optional<glm::vec3> colour{}; ///< of a v
    bool isLost = false;               ///< a v with nan or inf
};

/// Checks and cleans one line in place; the character after its end becomes a line feed. The text to pass on has one of
/// these forms, separated by blanks or tabs:
///
///     v  number number number     decimals that the parser of tinyobjloader reads without overflow or lost digits; 0 0 0
///                                 if the file has nan or inf
///     vn number number number     0 0 0 if the file has nan or inf
///     vt number number            or one number; likewise
///     f  corner corner corner...  corner = i | i/i | i//i | i/i/i, integers of 32 bits; v and vn not 0
///
/// Everything after the last of these numbers, or from a # in the place of a token, is dropped. So are slashes at the
/// end of a corner, because tinyobjloader would look for their number in the next corner. Throws Error{BadInput}
/// through `lines` for anything else, with what was found and what is allowed.
[[nodiscard]] CheckedStatement checkStatement(std::span<char> statement, const ObjLines &lines);

} // namespace hyalite
