// The cat: a walking cat as a smooth blend of tapered capsules. +y is up, the cat faces +x and stands on y = 0;
// one unit is about a centimetre. Its right side is towards +z.
#pragma once

#include "assets/cat/implicit.h"
#include "assets/cat/mesh.h"
#include "assets/cat/sparse_grid.h"

#include <cstddef>
#include <string>

namespace hyalite::cat {

// The soles are flat and a little below y = 0, so that the cat stands firmly on a floor that bends away.
inline constexpr double soleHeight = -0.25;

[[nodiscard]] Field makeCatField();

// A box that holds the cat with room to spare.
[[nodiscard]] Box catBounds();

// The cat with at least `minimumTriangleCount` triangles and at most 5 % more. 4,000 show the ears and the paws;
// throws std::runtime_error where so few are wanted that a thin part would break off.
[[nodiscard]] Mesh makeCat(std::size_t minimumTriangleCount);

// The OBJ text that make_cat writes.
[[nodiscard]] std::string formatCat(const Mesh &mesh);

} // namespace hyalite::cat
