// An indexed triangle mesh with one normal a vertex, and its OBJ form.
#pragma once

#include "assets/cat/vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hyalite::cat {

struct Mesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;                           // unit length, outward, one a position
    std::vector<std::array<std::uint32_t, 3>> triangles; // counter-clockwise seen from outside
};

// Wavefront OBJ text: a comment, then `v`, `vn` and `f a//a b//b c//c`. Numbers have five decimals and do not
// depend on the locale, so equal meshes give equal bytes.
[[nodiscard]] std::string formatObj(const Mesh &mesh, const std::string &comment);

} // namespace hyalite::cat
