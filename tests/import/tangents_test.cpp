// Tangents by MikkTSpace's definition.
#include "host/import/tangents.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hyalite::core {
namespace {

struct Surface {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;

    [[nodiscard]] Tangents tangents() const { return mikkTangents({positions, normals, uvs, triangles}); }
};

/// A unit square facing +z, its texture upright.
Surface square() {
    return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
            std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)),
            {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
            {{0, 1, 2}, {0, 2, 3}}};
}

glm::vec4 at(const Tangents &tangents, std::size_t triangle, glm::length_t corner) {
    return tangents.values[tangents.corners[triangle][corner]];
}

TEST(Tangents, PointAlongUWithTheSignOfV) {
    const Tangents upright = square().tangents();
    for (std::size_t triangle = 0; triangle < 2; ++triangle)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            EXPECT_EQ(at(upright, triangle, corner), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(upright.values.size(), 4u); // one a vertex
    Surface mirrored = square();
    for (glm::vec2 &uv : mirrored.uvs)
        uv.x = -uv.x;
    EXPECT_EQ(at(mirrored.tangents(), 0, 0),
              glm::vec4(-1, 0, 0, -1)); // cross((0, 0, 1), (-1, 0, 0)) * -1 is +y
}

TEST(Tangents, OfMirroredHalvesAreApartAtTheirSeam) {
    // u grows from the seam x = 0 to both sides.
    const Surface halves{{{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                         std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)),
                         {{1, 0}, {0, 0}, {0, 1}, {1, 0}},
                         {{0, 1, 2}, {1, 3, 2}}};
    const Tangents tangents = halves.tangents();
    EXPECT_EQ(at(tangents, 0, 1), glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(at(tangents, 1, 0), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(tangents.values.size(), 6u);
}

TEST(Tangents, AreTheMeanWeightedByAnglesOnceVerticesAreWelded) {
    // A roof: two squares share the edge x = 0, stored with vertices of their own; the normal there points up.
    const float s = std::sqrt(0.5f);
    const Surface roof{{{-1, 0, -1}, {0, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, -1}, {0, 1, 0}},
                       {{-s, 0, s}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {s, 0, s}, {0, 0, 1}},
                       {{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}, {1, 1}},
                       {{0, 1, 2}, {3, 4, 5}}};
    const Tangents tangents = roof.tangents();
    EXPECT_EQ(tangents.corners[0].y, tangents.corners[1].x); // welded
    const glm::vec4 middle = at(tangents, 0, 1);
    EXPECT_NEAR(middle.x, 1.0f, 1e-6f);
    EXPECT_NEAR(middle.z, 0.0f, 1e-6f);
    // At a side, the direction of u is projected to the plane of the normal there.
    EXPECT_NEAR(glm::dot(glm::vec3(at(tangents, 0, 0)), roof.normals[0]), 0.0f, 1e-6f);
}

TEST(Tangents, AreOrthonormalWhateverTheTriangles) {
    Surface surface;
    for (int i = 0; i <= 12; ++i)
        for (int j = 0; j <= 12; ++j) {
            const float x = static_cast<float>(i) / 12.0f;
            const float y = static_cast<float>(j) / 12.0f;
            surface.positions.emplace_back(x, y, std::sin(3.0f * x) * std::cos(4.0f * y));
            surface.normals.push_back(
                glm::normalize(glm::vec3(-3.0f * std::cos(3.0f * x) * std::cos(4.0f * y),
                                         4.0f * std::sin(3.0f * x) * std::sin(4.0f * y), 1.0f)));
            surface.uvs.emplace_back(x + 0.3f * y * y, y - 0.2f * x);
        }
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = 0; j < 12; ++j) {
            const std::uint32_t a = 13 * i + j;
            surface.triangles.emplace_back(a, a + 13, a + 14);
            surface.triangles.emplace_back(a, a + 14, a + 1);
        }
    const Tangents tangents = surface.tangents();
    EXPECT_EQ(tangents.values.size(), surface.positions.size());
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const glm::vec4 tangent = at(tangents, i, corner);
            EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-5f);
            EXPECT_NEAR(glm::dot(glm::vec3(tangent), surface.normals[surface.triangles[i][corner]]), 0.0f,
                        1e-5f);
            EXPECT_EQ(tangent.w, 1.0f);
        }
}

TEST(Tangents, OfATriangleWithoutTextureAreItsNeighboursOrAny) {
    Surface surface = square();
    surface.positions.emplace_back(1, 2, 0);
    surface.normals.emplace_back(0, 0, 1);
    surface.uvs.emplace_back(1, 1); // the corner (1, 1) again: no area in the texture
    surface.triangles.emplace_back(3, 2, 4);
    const Tangents tangents = surface.tangents();
    EXPECT_EQ(tangents.corners[2].x, tangents.corners[1].z);
    EXPECT_EQ(at(tangents, 2, 0), glm::vec4(1, 0, 0, 1));
    const glm::vec4 lonely = at(tangents, 2, 2);
    EXPECT_NEAR(glm::length(glm::vec3(lonely)), 1.0f, 1e-6f);
    EXPECT_EQ(lonely.z, 0.0f);
}

TEST(Tangents, DoNotTakeSquareTimeWhereManyTrianglesShareAnEdge) {
    Surface fan{{{0, 0, 0}, {0, 1, 0}}, std::vector<glm::vec3>(2, glm::vec3(0, 0, 1)), {{0, 0}, {0, 1}}, {}};
    for (std::uint32_t i = 0; i < 200000; ++i) {
        fan.positions.emplace_back(1.0f + static_cast<float>(i), 0.0f, 0.0f);
        fan.normals.emplace_back(0, 0, 1);
        fan.uvs.emplace_back(1, 0);
        fan.triangles.emplace_back(0u, i + 2, 1u);
    }
    EXPECT_EQ(fan.tangents().corners.size(), 200000u);
}

} // namespace
} // namespace hyalite::core
