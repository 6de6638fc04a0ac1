// The solids of glass that a mesh consists of.
#pragma once

#include "host/scene/scene.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace hyalite::core {

inline constexpr std::uint32_t noSolid = std::numeric_limits<std::uint32_t>::max();

struct Solids {
    std::vector<std::uint32_t> ofTriangles; ///< noSolid where the material is not glass
    std::uint32_t count = 0;
};

/// Triangles of one glass belong together where they share corners: by index if these make a closed surface, else by
/// position, as many files give each triangle, or each side of a crease, corners of its own.
[[nodiscard]] Solids solidsOf(const TriangleMesh &mesh, const std::vector<Material> &materials);

} // namespace hyalite::core
