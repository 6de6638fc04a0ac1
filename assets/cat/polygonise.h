// From a field to a closed triangle mesh.
#pragma once

#include "assets/cat/implicit.h"
#include "assets/cat/mesh.h"
#include "assets/cat/sparse_grid.h"

#include <cstddef>

namespace hyalite::cat {

// Meshes the surface of `field`, which must lie inside `bounds` and be a sphere topologically: closed, connected and
// without handles. Gives at least `minimumTriangleCount` triangles and at most 5 % more, by the choice of a grid
// spacing. Every edge belongs to exactly two triangles that run along it in opposite directions.
//
// Throws std::runtime_error when no spacing serves: too few triangles wanted for the details of the shape.
//
// The method is the dual of marching cubes (G. Nielson, "Dual Marching Cubes", 2004): one vertex for each piece of
// surface in a cell, one quadrilateral for each crossed grid edge. Vertices then slide along the surface towards
// the middle of their neighbours, which evens out the triangles.
[[nodiscard]] Mesh polygonise(const Field &field, const Box &bounds, std::size_t minimumTriangleCount);

} // namespace hyalite::cat
