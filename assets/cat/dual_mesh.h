// The quadrilaterals of a sampled grid: the dual of marching cubes.
#pragma once

#include "assets/cat/sparse_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hyalite::cat {

struct DualMesh {
    std::vector<Vec3> positions;                     // near the surface, not on it
    std::vector<std::uint32_t> vertexBlocks;         // the grid block that each vertex came from
    std::vector<std::array<std::uint32_t, 4>> quads; // counter-clockwise seen from outside
    bool hasAmbiguousFaces = false;                  // only then can an edge belong to more than two quads
};

[[nodiscard]] DualMesh buildDualMesh(const Field &field, const SparseGrid &grid);

// Whether each edge belongs to exactly two quads, in opposite directions.
[[nodiscard]] bool isManifold(const DualMesh &mesh);

} // namespace hyalite::cat
