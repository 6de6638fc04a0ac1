// Shapes: closed, seen from outside, of the right size, and lit as the formulas for lights of their form say.
#include "host/scene/shapes.h"

#include "tests/fixtures/radiance_fixture.h"

#include <array>
#include <numbers>
#include <set>
#include <tuple>

namespace hyalite::core {
namespace {

using hyalite::core::testing::expectRadiance;
using hyalite::core::testing::floorScene;

constexpr double pi = std::numbers::pi;

/// Area of a regular polygon in the unit circle.
double polygonArea(int segments) { return 0.5 * segments * std::sin(2.0 * pi / segments); }

glm::dvec3 corner(const TriangleMesh &mesh, const MeshTriangle &triangle, glm::length_t i) {
    return glm::dvec3(mesh.positions[triangle.positions[i]]);
}

glm::dvec3 areaVector(const TriangleMesh &mesh, const MeshTriangle &triangle) {
    const glm::dvec3 a = corner(mesh, triangle, 0);
    return 0.5 * glm::cross(corner(mesh, triangle, 1) - a, corner(mesh, triangle, 2) - a);
}

/// Enclosed by a closed mesh whose faces are counter-clockwise seen from outside.
double volume(const TriangleMesh &mesh) {
    double sum = 0.0;
    for (const MeshTriangle &triangle : mesh.triangles)
        sum += glm::dot(corner(mesh, triangle, 0), areaVector(mesh, triangle)) / 3.0;
    return sum;
}

using Point = std::tuple<float, float, float>;

/// How many edges have no partner in the opposite direction between the same two places.
std::size_t openEdges(const TriangleMesh &mesh) {
    std::multiset<std::pair<Point, Point>> edges;
    const auto point = [&](std::uint32_t index) {
        const glm::vec3 &p = mesh.positions[index];
        return Point(p.x, p.y, p.z);
    };
    for (const MeshTriangle &triangle : mesh.triangles)
        for (glm::length_t i = 0; i < 3; ++i)
            edges.emplace(point(triangle.positions[i]), point(triangle.positions[(i + 1) % 3]));
    std::size_t count = 0;
    for (const auto &[from, to] : edges)
        count += edges.count({from, to}) == 1 && edges.count({to, from}) == 1 ? 0 : 1;
    return count;
}

/// Shears, stretches and moves; its volume is 3 times as large, or -3 times if it mirrors.
glm::dmat4x3 skewed(bool isMirroring) {
    return {{isMirroring ? -1.5 : 1.5, 0.2, 0.1}, {0.0, 2.0, 0.3}, {0.0, 0.0, 1.0}, {10.0, -20.0, 5.0}};
}

TEST(Shapes, OfAVolumeAreClosed) {
    for (const glm::dmat4x3 &map : {glm::dmat4x3(1.0), skewed(false), skewed(true)}) {
        EXPECT_EQ(openEdges(transformed(makeShape(ShapeKind::Box, 0), map)), 0u);
        for (const int segments : {3, 4, 5, 64, 4096})
            EXPECT_EQ(openEdges(transformed(makeShape(ShapeKind::Cylinder, segments), map)), 0u) << segments;
    }
    EXPECT_EQ(openEdges(makeShape(ShapeKind::Quad, 0)), 4u);
    EXPECT_EQ(openEdges(makeShape(ShapeKind::Disk, 7)), 7u);
}

TEST(Shapes, AreAsLargeAsTheirFormAndFaceOutwards) {
    EXPECT_DOUBLE_EQ(volume(makeShape(ShapeKind::Box, 0)), 8.0);
    for (const int segments : {3, 4, 5, 64, 4096}) {
        const double area = polygonArea(segments);
        EXPECT_NEAR(volume(makeShape(ShapeKind::Cylinder, segments)), 2.0 * area, 1e-5);
        glm::dvec3 sum(0.0);
        const TriangleMesh disk = makeShape(ShapeKind::Disk, segments);
        for (const MeshTriangle &triangle : disk.triangles)
            sum += areaVector(disk, triangle);
        EXPECT_NEAR(glm::distance(sum, glm::dvec3(0, 0, area)), 0.0, 1e-5);
    }
    const TriangleMesh quad = makeShape(ShapeKind::Quad, 0);
    EXPECT_EQ(areaVector(quad, quad.triangles.at(0)), glm::dvec3(0, 0, 2));
    EXPECT_EQ(areaVector(quad, quad.triangles.at(1)), glm::dvec3(0, 0, 2));
}

TEST(Shapes, StayOutsideOutUnderMapsThatMirror) {
    for (const bool isMirroring : {false, true}) {
        const TriangleMesh box = transformed(makeShape(ShapeKind::Box, 0), skewed(isMirroring));
        EXPECT_NEAR(volume(box), 24.0, 1e-4);
        const TriangleMesh cylinder = transformed(makeShape(ShapeKind::Cylinder, 64), skewed(isMirroring));
        EXPECT_NEAR(volume(cylinder), 6.0 * polygonArea(64), 1e-3);
    }
}

TEST(Shapes, HaveNormalsOfTheSurface) {
    for (const glm::dmat4x3 &map : {glm::dmat4x3(1.0), skewed(false), skewed(true)}) {
        const TriangleMesh mesh = transformed(makeShape(ShapeKind::Cylinder, 256), map);
        std::size_t smoothCount = 0;
        for (const MeshTriangle &triangle : mesh.triangles) {
            if (triangle.normals.x == MeshTriangle::noNormal)
                continue;
            ++smoothCount;
            const glm::dvec3 flat = glm::normalize(areaVector(mesh, triangle));
            for (glm::length_t i = 0; i < 3; ++i) {
                const glm::dvec3 normal(mesh.normals.at(triangle.normals[i]));
                EXPECT_NEAR(glm::length(normal), 1.0, 1e-6);
                EXPECT_GT(glm::dot(normal, flat), 0.999);
            }
        }
        EXPECT_EQ(smoothCount, 512u);
    }
}

TEST(Shapes, HaveTextureCoordinatesThatAreNotMirrored) {
    for (const auto kind : {ShapeKind::Quad, ShapeKind::Box, ShapeKind::Disk, ShapeKind::Cylinder}) {
        const TriangleMesh mesh = makeShape(kind, 8);
        ASSERT_EQ(mesh.triangleUvs.size(), mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            std::array<glm::dvec2, 3> uvs{};
            for (glm::length_t j = 0; j < 3; ++j) {
                const glm::vec2 &uv = mesh.uvs.at(mesh.triangleUvs[i][j]);
                EXPECT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
                uvs.at(static_cast<std::size_t>(j)) = glm::dvec2(uv);
            }
            const glm::dvec2 a = uvs[1] - uvs[0];
            const glm::dvec2 b = uvs[2] - uvs[0];
            EXPECT_GT(a.x * b.y - a.y * b.x, 0.0) << "triangle " << i;
        }
    }
}

// ---- Light from shapes, on the floor at the origin that faces +z

TestScene litBy(TriangleMesh lamp) {
    Material floor;
    floor.albedo = glm::vec3(0.5f);
    Material glow;
    glow.albedo = glm::vec3(0.0f);
    glow.emission = glm::vec3(3.0f);
    TestScene scene = floorScene(floor, 4096);
    scene.materials.push_back(glow);
    scene.meshes.push_back(std::move(lamp));
    scene.meshes[1].materialIndex = 1;
    return scene;
}

glm::dmat4x3 scaledAndMoved(const glm::dvec3 &scale, const glm::dvec3 &offset) {
    return {{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}, offset};
}

TEST(ShapesAsLights, DiskLightsByTheClosedFormOfADisk) {
    // A disk of radius r at height h that faces down, because it is mirrored: pi L r^2 / (r^2 + h^2).
    const double irradiance = pi * 3.0 * 0.5625 / (0.5625 + 1.0);
    const TriangleMesh lamp =
        transformed(makeShape(ShapeKind::Disk, 4096), scaledAndMoved({0.75, 0.75, -1.0}, {0, 0, 1}));
    expectRadiance(litBy(lamp), 0.5 / pi * irradiance, 2e-3);
}

TEST(ShapesAsLights, BoxLightsAsItsLowerSide) {
    // Four rectangles of a by b at height h, each with a corner above the point (Howell, "A Catalog of Radiation Heat
    // Transfer Configuration Factors", B-3).
    const double a = 0.5;
    const double b = 0.8;
    const double h = 0.9;
    const double x = a / h;
    const double y = b / h;
    const double share = 4.0 / (2.0 * pi) *
                         (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
                          y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y)));
    const TriangleMesh lamp =
        transformed(makeShape(ShapeKind::Box, 0), scaledAndMoved({a, b, 0.2}, {0, 0, h + 0.2}));
    expectRadiance(litBy(lamp), 0.5 * 3.0 * share, 2e-3);
}

} // namespace
} // namespace hyalite::core
