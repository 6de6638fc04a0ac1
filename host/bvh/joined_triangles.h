// Pairs of triangles, which builders take as one: a kernel tests two that have an edge in common at once.
#pragma once

#include "host/bvh/bvh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core {

/// A flag for each triangle, by its index in the input: it is in one item with the next of its mesh. Empty: none is.
using JoinedItems = std::vector<bool>;

[[nodiscard]] inline bool isPair(const JoinedItems &isJoined, const BuildTriangle &item) {
    return item.inputIndex < isJoined.size() && isJoined[item.inputIndex];
}

/// Joins each triangle with the one that follows it in its mesh if they have a material and an edge in common, which
/// runs through them in opposite directions, and if neither is in a pair yet. Where a mesh was made of quads these are
/// their halves; the best pairs that there are would save rays no more.
///
/// `items` begins with triangles of `meshes`, by increasing index; other items may follow. Of each pair the first
/// stays, with the box around both and the middle of it as its centroid; the second is removed.
[[nodiscard]] JoinedItems joinTriangles(std::span<const TriangleMesh> meshes,
                                        std::vector<BuildTriangle> &items);

} // namespace hyalite::core
