#include "host/packing/listed_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>
#include <vector>

namespace hyalite::core {
namespace {

layout::TriangleRecord triangle(glm::vec3 v0, glm::vec3 v1, glm::vec3 v2) {
    layout::TriangleRecord record{};
    record.v0 = v0;
    record.v1 = v1;
    record.v2 = v2;
    return record;
}

using Vertices = std::array<std::tuple<float, float, float>, 3>;

/// In one order, whatever theirs was.
Vertices sorted(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    Vertices vertices{std::tuple{a.x, a.y, a.z}, std::tuple{b.x, b.y, b.z}, std::tuple{c.x, c.y, c.z}};
    std::ranges::sort(vertices);
    return vertices;
}

Vertices verticesOf(const layout::TriangleRecord &record) { return sorted(record.v0, record.v1, record.v2); }

/// Each triangle is in one pair, with its own vertices.
void expectAll(const std::vector<layout::TriangleRecord> &triangles,
               const std::vector<layout::TrianglePair> &pairs) {
    std::vector<int> timesFound(triangles.size(), 0);
    const auto find = [&](std::uint32_t bit, const Vertices &vertices) {
        ASSERT_TRUE(std::has_single_bit(bit));
        const auto index = static_cast<std::size_t>(std::countr_zero(bit));
        ASSERT_LT(index, triangles.size());
        EXPECT_EQ(vertices, verticesOf(triangles[index])) << "triangle " << index;
        ++timesFound[index];
    };
    for (const layout::TrianglePair &pair : pairs) {
        find(pair.first, sorted(pair.v0, pair.v1, pair.v2));
        if (pair.second != 0)
            find(pair.second, sorted(pair.v0, pair.v2, pair.v3));
    }
    EXPECT_EQ(timesFound, std::vector<int>(triangles.size(), 1));
}

constexpr glm::vec3 a{0, 0, 0};
constexpr glm::vec3 b{1, 0, 0};
constexpr glm::vec3 c{1, 1, 0};
constexpr glm::vec3 d{0, 1, 0};
constexpr glm::vec3 e{2, 3, 4};

TEST(ListedTriangles, AreNoneOfNone) { EXPECT_TRUE(pairTriangles({}).empty()); }

TEST(ListedTriangles, WithACommonEdgeArePairs) {
    // Every way in which the vertices of a quadrilateral can be turned, with triangles of the same side and of two.
    const std::array<std::array<glm::vec3, 3>, 6> orders{
        {{a, c, d}, {c, d, a}, {d, a, c}, {c, a, d}, {a, d, c}, {d, c, a}}};
    for (const auto &[v0, v1, v2] : orders) {
        const std::vector triangles{triangle(a, b, c), triangle(v0, v1, v2)};
        const auto pairs = pairTriangles(triangles);
        EXPECT_EQ(pairs.size(), 1u);
        expectAll(triangles, pairs);
    }
}

TEST(ListedTriangles, WithoutACommonEdgeAreAlone) {
    const std::vector triangles{triangle(a, b, c), triangle(a, d, e), triangle(b, d, e)};
    const auto pairs = pairTriangles(triangles);
    EXPECT_EQ(pairs.size(), 2u); // the second and the third share an edge
    expectAll(triangles, pairs);
}

TEST(ListedTriangles, MayBeAsManyAsBitsOfAWord) {
    std::vector<layout::TriangleRecord> triangles;
    for (std::uint32_t i = 0; i < layout::maxListedTriangles; ++i) {
        const glm::vec3 moved{0, 0, static_cast<float>(i / 3)};
        triangles.push_back(i % 3 == 0   ? triangle(a + moved, b + moved, c + moved)
                            : i % 3 == 1 ? triangle(a + moved, c + moved, d + moved)
                                         : triangle(c + moved, d + moved, e + moved));
    }
    expectAll(triangles, pairTriangles(triangles));
}

} // namespace
} // namespace hyalite::core
