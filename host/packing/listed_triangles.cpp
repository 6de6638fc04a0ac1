#include "host/packing/listed_triangles.h"

#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <optional>

namespace hyalite {

namespace {

using Bits = std::array<std::uint32_t, 3>;

bool haveEqualBits(const glm::vec3 &a, const glm::vec3 &b) {
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

std::array<glm::vec3, 3> verticesOf(const layout::TriangleRecord &triangle) {
    return {triangle.v0, triangle.v1, triangle.v2};
}

/// The pair of two triangles whose common edge runs from one to the other of its vertices v0 and v2, or nothing.
std::optional<layout::TrianglePair> joined(const layout::TriangleRecord &first,
                                           const layout::TriangleRecord &second) {
    const std::array<glm::vec3, 3> a = verticesOf(first);
    const std::array<glm::vec3, 3> b = verticesOf(second);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const glm::vec3 &begin = a[i];
            const glm::vec3 &end = a[(i + 1) % 3];
            const bool isOpposite = haveEqualBits(b[(j + 1) % 3], begin) && haveEqualBits(b[j], end);
            const bool isAlike = haveEqualBits(b[j], begin) && haveEqualBits(b[(j + 1) % 3], end);
            if (isOpposite || isAlike)
                return layout::TrianglePair{begin, 0, a[(i + 2) % 3], 0, end, 0, b[(j + 2) % 3], 0};
        }
    return std::nullopt;
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

} // namespace hyalite
