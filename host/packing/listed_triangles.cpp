#include "host/packing/listed_triangles.h"

#include "host/bvh/common_edge.h"

#include <cassert>
#include <cstdint>
#include <optional>

namespace hyalite::core {

namespace {

Corners cornersOf(const layout::TriangleRecord &triangle) { return {triangle.v0, triangle.v1, triangle.v2}; }

/// The pair of two triangles whose common edge runs from one to the other of its vertices v0 and v2, or nothing.
std::optional<layout::TrianglePair> joined(const layout::TriangleRecord &first,
                                           const layout::TriangleRecord &second) {
    const Corners a = cornersOf(first);
    const Corners b = cornersOf(second);
    const std::optional<CommonEdge> edge = commonEdge(a, b);
    if (!edge)
        return std::nullopt;
    const auto &[i, j, isOpposite] = *edge;
    return layout::TrianglePair{a[i], 0, a[(i + 2) % 3], 0, a[(i + 1) % 3], 0, b[(j + 2) % 3], 0};
}

} // namespace

std::vector<layout::TrianglePair> pairTriangles(std::span<const layout::TriangleRecord> triangles) {
    assert(triangles.size() <= layout::maxListedTriangles);
    std::vector<layout::TrianglePair> pairs;
    std::uint32_t paired = 0; // a bit each
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if ((paired >> i & 1u) != 0)
            continue;
        const layout::TriangleRecord &first = triangles[i];
        layout::TrianglePair pair{first.v0, 0, first.v1, 0, first.v2, 0, first.v2, 0};
        for (std::size_t j = i + 1; j < triangles.size() && pair.second == 0; ++j) {
            if ((paired >> j & 1u) != 0)
                continue;
            if (const auto both = joined(first, triangles[j])) {
                pair = *both;
                pair.second = 1u << j;
            }
        }
        pair.first = 1u << i;
        paired |= pair.first | pair.second;
        pairs.push_back(pair);
    }
    return pairs;
}

} // namespace hyalite::core
