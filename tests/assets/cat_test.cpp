// The cat's mesh: counts, topology, normals, pose, and the very bytes that are written.
#include "assets/cat/cat_model.h"
#include "assets/cat/mesh.h"
#include "assets/cat/sparse_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::cat {
namespace {

constexpr std::size_t coarseCount = 4000;
constexpr std::size_t fineCount = 144000;

struct Case {
    std::size_t wanted;
    Mesh mesh;
};

// Made once: the fine cat takes a second or two.
const std::vector<Case> &cats() {
    static const std::vector<Case> made = [] {
        std::vector<Case> cases;
        for (const std::size_t wanted : {coarseCount, fineCount})
            cases.push_back({wanted, makeCat(wanted)});
        return cases;
    }();
    return made;
}

std::uint64_t fnv1a64(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const char byte : bytes) {
        hash ^= static_cast<unsigned char>(byte);
        hash *= 0x100000001b3ull;
    }
    return hash;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Edge> sortedDirectedEdges(const Mesh &mesh) {
    std::vector<Edge> edges;
    for (const auto &triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            edges.emplace_back(triangle[i], triangle[(i + 1) % 3]);
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::uint32_t findRoot(std::vector<std::uint32_t> &parents, std::uint32_t vertex) {
    while (parents[vertex] != vertex) {
        parents[vertex] = parents[parents[vertex]];
        vertex = parents[vertex];
    }
    return vertex;
}

std::size_t componentCount(const Mesh &mesh) {
    std::vector<std::uint32_t> parents(mesh.positions.size());
    std::iota(parents.begin(), parents.end(), 0u);
    for (const auto &triangle : mesh.triangles)
        for (const std::size_t i : {1u, 2u})
            parents[findRoot(parents, triangle[i])] = findRoot(parents, triangle[0]);
    std::size_t count = 0;
    for (std::uint32_t vertex = 0; vertex < parents.size(); ++vertex)
        count += parents[vertex] == vertex ? 1 : 0;
    return count;
}

Box boundsOf(const Mesh &mesh) {
    Box box{mesh.positions.front(), mesh.positions.front()};
    for (const Vec3 &p : mesh.positions) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    return box;
}

Vec3 areaNormal(const Mesh &mesh, const std::array<std::uint32_t, 3> &triangle) {
    const Vec3 &a = mesh.positions[triangle[0]];
    return cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
}

TEST(Cat, HasTheWantedTriangleCount) {
    for (const Case &cat : cats()) {
        EXPECT_GE(cat.mesh.triangles.size(), cat.wanted);
        EXPECT_LE(cat.mesh.triangles.size() * 100, cat.wanted * 105);
    }
}

TEST(Cat, IsClosedAndManifold) {
    for (const Case &cat : cats()) {
        const std::vector<Edge> edges = sortedDirectedEdges(cat.mesh);
        EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end()) << cat.wanted;
        std::size_t unpairedCount = 0;
        for (const auto &[from, to] : edges)
            unpairedCount += std::binary_search(edges.begin(), edges.end(), Edge{to, from}) ? 0 : 1;
        EXPECT_EQ(unpairedCount, 0u) << cat.wanted;
    }
}

TEST(Cat, IsOnePieceWithoutHandles) {
    for (const Case &cat : cats()) {
        EXPECT_EQ(componentCount(cat.mesh), 1u) << cat.wanted;
        // V - E + F, with two triangles at every edge.
        EXPECT_EQ(cat.mesh.positions.size() * 2, cat.mesh.triangles.size() + 4) << cat.wanted;
    }
}

TEST(Cat, NormalsAreUnitAndOutward) {
    for (const Case &cat : cats()) {
        ASSERT_EQ(cat.mesh.normals.size(), cat.mesh.positions.size());
        for (const Vec3 &normal : cat.mesh.normals)
            ASSERT_NEAR(length(normal), 1.0, 1e-12);
        std::size_t againstCount = 0;
        for (const auto &triangle : cat.mesh.triangles)
            for (const std::uint32_t vertex : triangle)
                againstCount += dot(areaNormal(cat.mesh, triangle), cat.mesh.normals[vertex]) <= 0.0 ? 1 : 0;
        EXPECT_EQ(againstCount, 0u) << cat.wanted;
    }
}

TEST(Cat, WindingEnclosesThePositiveVolumeOfACat) {
    for (const Case &cat : cats()) {
        double sixVolumes = 0.0;
        for (const auto &triangle : cat.mesh.triangles)
            sixVolumes += dot(cat.mesh.positions[triangle[0]], areaNormal(cat.mesh, triangle));
        EXPECT_GT(sixVolumes / 6.0, 3000.0) << cat.wanted;
        EXPECT_LT(sixVolumes / 6.0, 6000.0) << cat.wanted;
    }
}

TEST(Cat, HasNoSlivers) {
    for (const Case &cat : cats())
        for (const auto &triangle : cat.mesh.triangles) {
            // 1 for an equilateral triangle, 0 for a line.
            double squares = 0.0;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 side = cat.mesh.positions[triangle[(i + 1) % 3]] - cat.mesh.positions[triangle[i]];
                squares += dot(side, side);
            }
            const double quality = 2.0 * std::sqrt(3.0) * length(areaNormal(cat.mesh, triangle)) / squares;
            // The coarse grid is wider than the ears are thick.
            ASSERT_GT(quality, cat.wanted == coarseCount ? 0.05 : 0.3) << cat.wanted;
        }
}

TEST(Cat, VerticesLieOnTheSurface) {
    const Field field = makeCatField();
    const Selection all = field.selectAll();
    for (const Vec3 &p : cats().front().mesh.positions)
        ASSERT_NEAR(field.value(all, p), 0.0, 1e-3);
}

TEST(Cat, IsAsLargeAsTheSceneExpects) {
    for (const Case &cat : cats()) {
        const Box box = boundsOf(cat.mesh);
        EXPECT_NEAR(box.low.x, -35.0, 2.0);
        EXPECT_NEAR(box.high.x, 30.0, 2.0);
        EXPECT_NEAR(box.high.y, 45.0, 1.5);
        EXPECT_NEAR(box.low.z, -6.5, 1.5);
        EXPECT_NEAR(box.high.z, 6.5, 1.5);
    }
}

TEST(Cat, StandsOnFourPaws) {
    for (const Case &cat : cats()) {
        EXPECT_NEAR(boundsOf(cat.mesh).low.y, soleHeight, 0.02) << cat.wanted;
        // One paw a quarter of the floor plan; each reaches down as far as the others.
        for (const double front : {1.0, -1.0})
            for (const double right : {1.0, -1.0}) {
                double lowest = 1e9;
                for (const Vec3 &p : cat.mesh.positions)
                    if (p.x * front > 0.0 && p.z * right > 0.0)
                        lowest = std::min(lowest, p.y);
                EXPECT_NEAR(lowest, soleHeight, 0.05) << cat.wanted << ' ' << front << ' ' << right;
            }
    }
}

TEST(Cat, FacesForward) {
    // The highest point is the tail's tip, behind; the foremost is the nose, above the paws.
    for (const Case &cat : cats()) {
        const auto &positions = cat.mesh.positions;
        const auto highest = std::max_element(positions.begin(), positions.end(),
                                              [](const Vec3 &a, const Vec3 &b) { return a.y < b.y; });
        const auto foremost = std::max_element(positions.begin(), positions.end(),
                                               [](const Vec3 &a, const Vec3 &b) { return a.x < b.x; });
        EXPECT_LT(highest->x, -25.0);
        EXPECT_GT(foremost->y, 25.0);
    }
}

TEST(Cat, SelectionGivesTheBitsOfTheWholeField) {
    const Field field = makeCatField();
    const Selection all = field.selectAll();
    // A fixed walk through the box: multiples of irrational-like steps, folded back into [0, 1).
    const Box box = catBounds();
    double u = 0.0;
    double v = 0.0;
    double w = 0.0;
    const auto fold = [](double x) { return x - std::floor(x); };
    for (int i = 0; i < 2000; ++i) {
        u = fold(u + 0.8191725134);
        v = fold(v + 0.6710436067);
        w = fold(w + 0.5497004779);
        const Vec3 centre{box.low.x + u * (box.high.x - box.low.x), box.low.y + v * (box.high.y - box.low.y),
                          box.low.z + w * (box.high.z - box.low.z)};
        const double radius = 0.2 + 3.0 * fold(7.0 * u);
        const Selection selection = field.select(all, {centre, radius});
        const Vec3 inside = centre + normalize({v - 0.5, w - 0.5, u - 0.4}) * (radius * w);
        ASSERT_EQ(field.value(selection, inside), field.value(all, inside)) << i;
        ASSERT_EQ(field.sample(selection, inside).value, field.value(all, inside)) << i;
    }
}

TEST(Cat, FieldNeverChangesFasterThanTheDistance) {
    const Field field = makeCatField();
    const Selection all = field.selectAll();
    const Box box = catBounds();
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p{box.low.x + (i * 37 % 3000) / 3000.0 * (box.high.x - box.low.x),
                     box.low.y + (i * 1013 % 3000) / 3000.0 * (box.high.y - box.low.y),
                     box.low.z + (i * 1999 % 3000) / 3000.0 * (box.high.z - box.low.z)};
        const FieldSample here = field.sample(all, p);
        ASSERT_LE(length(here.gradient), 1.0 + 1e-9) << i;
        // The gradient is that of the value.
        const double step = 1e-6;
        const double ahead = field.value(all, p + here.gradient * step);
        const double behind = field.value(all, p - here.gradient * step);
        ASSERT_NEAR((ahead - behind) / (2.0 * step), dot(here.gradient, here.gradient), 1e-4) << i;
    }
}

TEST(Cat, IsTheSameEveryTime) { EXPECT_EQ(formatCat(makeCat(coarseCount)), formatCat(cats().front().mesh)); }

// Any change of the model or the mesher changes these; a new compiler or machine must not.
TEST(Cat, WritesTheRecordedBytes) {
    EXPECT_EQ(fnv1a64(formatCat(cats()[0].mesh)), 0x413c16ea18714eb9ull);
    EXPECT_EQ(fnv1a64(formatCat(cats()[1].mesh)), 0x0252c4acaf4f40a0ull);
}

TEST(Cat, ObjTextHasFixedDecimalsAndNoNegativeZero) {
    Mesh mesh;
    mesh.positions = {{-1e-9, 1.5, -2.25}, {1.0, 0.0, 0.0}, {0.0, 1.0, 123.456789}};
    mesh.normals = {{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}};
    mesh.triangles = {{0, 1, 2}};
    EXPECT_EQ(formatObj(mesh, "three"), "# three\n"
                                        "v 0.00000 1.50000 -2.25000\n"
                                        "v 1.00000 0.00000 0.00000\n"
                                        "v 0.00000 1.00000 123.45679\n"
                                        "vn 0.00000 0.00000 1.00000\n"
                                        "vn 0.00000 0.00000 1.00000\n"
                                        "vn 0.00000 0.00000 1.00000\n"
                                        "f 1//1 2//2 3//3\n");
}

} // namespace
} // namespace hyalite::cat
