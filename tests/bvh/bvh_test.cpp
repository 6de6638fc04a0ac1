#include "host/bvh/bvh.h"

#include "host/bvh/split.h"
#include "host/bvh/tree_statistics.h"
#include "shaders/layout/layout.h"
#include "tests/fixtures/geometry_fixture.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace hyalite::core {
namespace {

using testing::Random;

struct Soup {
    std::string name;
    TriangleMesh mesh;
};

/// Meshes that a builder could stumble over.
std::vector<Soup> hostileSoups() {
    Random random(11);
    std::vector<Soup> soups;
    soups.push_back({"nothing", {}});
    soups.push_back({"one triangle", testing::triangleSoup(random, 1, 1.0, 1.0)});
    soups.push_back({"two triangles", testing::triangleSoup(random, 2, 1.0, 1.0)});
    soups.push_back({"random", testing::triangleSoup(random, 3000, 1.0, 0.05)});
    TriangleMesh clusters;
    for (int i = 0; i < 30; ++i) {
        const glm::dvec3 centre = random.inCube(100.0);
        const TriangleMesh cluster =
            testing::triangleSoup(random, 100, random.logUniform(1e-4, 1.0), 0.01, centre);
        for (const MeshTriangle &corner : cluster.triangles)
            testing::addTriangle(clusters, cluster.positions[corner.positions.x],
                                 cluster.positions[corner.positions.y],
                                 cluster.positions[corner.positions.z]);
    }
    soups.push_back({"clustered", clusters});
    TriangleMesh nested; // each half the size of the one before, down to denormals, all at one corner
    for (int i = 0; i < 280; ++i) {
        const float size = std::ldexp(1.0f, 130 - i);
        if (std::isfinite(size))
            testing::addTriangle(nested, {size, 0, 0}, {0, size, 0}, {0, 0, size});
    }
    soups.push_back({"exponentially nested", nested});
    TriangleMesh apart; // at distances of 2^i: the midpoint cuts off one at a time
    for (int i = 0; i < 250; ++i)
        testing::addTriangle(apart, {std::ldexp(1.0f, i - 130), 0, 0}, {std::ldexp(1.0f, i - 130), 1e-9f, 0},
                             {std::ldexp(1.0f, i - 130), 0, 1e-9f});
    soups.push_back({"exponentially spaced", apart});
    TriangleMesh points;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 point(random.inCube(1.0));
        testing::addTriangle(points, point, point, i % 2 == 0 ? point : point + glm::vec3(0.1f));
    }
    soups.push_back({"all degenerate", points});
    TriangleMesh giant = testing::triangleSoup(random, 2000, 1.0, 0.01);
    testing::addTriangle(giant, {-1e6f, 0, -1e6f}, {1e6f, 0, -1e6f}, {0, 0, 1e6f});
    soups.push_back({"one giant among many tiny", giant});
    TriangleMesh collinear;
    for (int i = 0; i < 4000; ++i) {
        const float x = static_cast<float>(i);
        testing::addTriangle(collinear, {x, 2, 3}, {x + 0.5f, 2, 3}, {x + 1, 2, 3});
    }
    soups.push_back({"collinear", collinear});
    soups.push_back({"huge", testing::triangleSoup(random, 2000, 1e15, 1e13)});
    soups.push_back({"tiny", testing::triangleSoup(random, 2000, 1e-30, 1e-32)});
    soups.push_back({"far away", testing::triangleSoup(random, 2000, 1.0, 0.1, glm::dvec3(1e6))});
    TriangleMesh flat; // a grid in a plane
    for (int i = 0; i < 40; ++i)
        for (int k = 0; k < 40; ++k)
            testing::addQuad(flat, {i, 0, k}, {1, 0, 0}, {0, 0, 1});
    soups.push_back({"flat", flat});
    soups.push_back({"few centroids", testing::triangleSoup(random, 2000, 0.0, 0.0)});
    return soups;
}

void expectSame(const Bvh &bvh, const Bvh &expected) {
    EXPECT_EQ(bvh.order, expected.order);
    EXPECT_EQ(bvh.depth, expected.depth);
    ASSERT_EQ(bvh.nodes.size(), expected.nodes.size());
    EXPECT_TRUE(
        std::ranges::equal(std::as_bytes(std::span(bvh.nodes)), std::as_bytes(std::span(expected.nodes))));
}

/// Also checks that the tree is the same when it is built again.
void expectValid(TreeKind kind, const std::vector<BuildTriangle> &triangles, int leafSize) {
    const Bvh bvh = buildBvh(kind, triangles, leafSize);
    EXPECT_EQ(findBvhFault(bvh, triangles), "");
    EXPECT_LT(bvh.depth, static_cast<int>(layout::maxTreeDepth));
    EXPECT_EQ(bvh.nodes.empty(), triangles.empty());
    std::vector<std::uint32_t> sorted = bvh.order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(sorted, all);
    std::size_t leafTotal = 0;
    for (const BvhNode &node : bvh.nodes) {
        if (!node.isLeaf())
            continue;
        leafTotal += node.count;
        EXPECT_TRUE(kind == TreeKind::None || node.count <= static_cast<std::uint32_t>(leafSize));
    }
    EXPECT_EQ(leafTotal, triangles.size());
    if (kind == TreeKind::None && !triangles.empty()) {
        EXPECT_EQ(bvh.nodes.size(), 1u);
        EXPECT_EQ(bvh.depth, 0);
    }

    expectSame(buildBvh(kind, triangles, leafSize), bvh);
}

constexpr TreeKind allKinds[] = {TreeKind::None, TreeKind::Midpoint, TreeKind::Sah};

TEST(Bvh, IsValidOnHostileMeshesAtEveryKindAndLeafSize) {
    for (Soup &soup : hostileSoups()) {
        const std::vector<BuildTriangle> triangles = buildTriangles(testing::sceneOf(soup.mesh));
        for (const TreeKind kind : allKinds) {
            for (const int leafSize : {1, 2, 3, 4, 7, 8, 16, 31, 32, 64}) {
                SCOPED_TRACE(
                    fmt::format("{}, kind {}, leaf size {}", soup.name, static_cast<int>(kind), leafSize));
                expectValid(kind, triangles, leafSize);
            }
        }
    }
}

TEST(Bvh, EveryLeafSizeFrom1To64IsKept) {
    Random random(12);
    const std::vector<BuildTriangle> triangles =
        buildTriangles(testing::sceneOf(testing::triangleSoup(random, 700, 1.0, 0.1)));
    for (int leafSize = 1; leafSize <= 64; ++leafSize) {
        SCOPED_TRACE(leafSize);
        expectValid(TreeKind::Midpoint, triangles, leafSize);
        expectValid(TreeKind::Sah, triangles, leafSize);
    }
}

TEST(Bvh, IsTheSameForAnyNumberOfThreads) {
    Random random(15);
    TriangleMesh lopsided = testing::triangleSoup(random, 30'000, 0.01, 1e-4);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 point(random.inCube(1.0));
        testing::addTriangle(lopsided, point, point + glm::vec3(0.01f, 0, 0), point + glm::vec3(0, 0.01f, 0));
    }
    TriangleMesh identical; // and zeros of both signs
    identical.positions = {{1, 0, 3}, {2, -0.0f, 3}, {1, 0, 3.5f}};
    identical.triangles.assign(20'000, {{0, 1, 2}});
    for (int i = 0; i < 20'000; ++i)
        identical.triangles.push_back(i % 2 == 0 ? MeshTriangle{{1, 2, 0}} : MeshTriangle{{2, 0, 1}});
    const int threadCountBefore = omp_get_max_threads();
    for (const TriangleMesh &mesh :
         {testing::triangleSoup(random, 60'000, 1.0, 0.01), testing::icosphere(6), lopsided, identical}) {
        const std::vector<BuildTriangle> triangles = buildTriangles(testing::sceneOf(mesh));
        for (const TreeKind kind : allKinds) {
            omp_set_num_threads(1);
            const Bvh expected = buildBvh(kind, triangles, 4);
            EXPECT_EQ(findBvhFault(expected, triangles), "");
            for (const int threadCount : {2, 3, 8}) {
                SCOPED_TRACE(fmt::format("{} triangles, kind {}, {} threads", triangles.size(),
                                         static_cast<int>(kind), threadCount));
                omp_set_num_threads(threadCount);
                for (int repetition = 0; repetition < 3; ++repetition)
                    expectSame(buildBvh(kind, triangles, 4), expected);
            }
        }
    }
    omp_set_num_threads(threadCountBefore);
}

TEST(Bvh, AHundredThousandIdenticalTrianglesAreHalved) {
    TriangleMesh mesh;
    mesh.positions = {{1, 2, 3}, {2, 2, 3}, {1, 3, 3.5f}};
    mesh.triangles.assign(100'000, {{0, 1, 2}});
    const std::vector<BuildTriangle> triangles = buildTriangles(testing::sceneOf(std::move(mesh)));
    for (const TreeKind kind : {TreeKind::Midpoint, TreeKind::Sah}) {
        for (const int leafSize : {1, 8, 64}) {
            SCOPED_TRACE(fmt::format("kind {}, leaf size {}", static_cast<int>(kind), leafSize));
            expectValid(kind, triangles, leafSize);
            EXPECT_LE(buildBvh(kind, triangles, leafSize).depth, 17);
        }
    }
}

TEST(Bvh, DepthStaysBelowTheLimitWhereMidpointsCutOffOneAtATime) {
    // Centroids at 2^i, many times over: unbounded midpoint cuts would go 250 levels down.
    std::vector<BuildTriangle> triangles;
    for (int i = -126; i <= 126; ++i) {
        for (int copy = 0; copy < 100; ++copy) {
            BuildTriangle triangle;
            triangle.centroid = glm::vec3(std::ldexp(1.0f, i), 0.0f, 0.0f);
            triangle.box.extend(triangle.centroid);
            triangle.inputIndex = static_cast<std::uint32_t>(triangles.size());
            triangles.push_back(triangle);
        }
    }
    const Bvh bvh = buildBvh(TreeKind::Midpoint, triangles, 1);
    EXPECT_EQ(findBvhFault(bvh, triangles), "");
    EXPECT_GT(bvh.depth, 40);
    EXPECT_LE(bvh.depth, static_cast<int>(layout::maxTreeDepth) - 1);
}

TEST(Bvh, WhatABuilderIsToldOfATriangle) {
    Scene scene = testing::sceneOf({});
    testing::addTriangle(scene.meshes[0], {0, 0, 0}, {3, 0, 0}, {0, 6, 0});
    scene.meshes.push_back({});
    testing::addTriangle(scene.meshes[1], {-1, -1, -1}, {2, 2, 2}, {2, -1, 5});
    const std::vector<BuildTriangle> triangles = buildTriangles(scene);
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(triangles[0].box.lower, glm::vec3(0, 0, 0));
    EXPECT_EQ(triangles[0].box.upper, glm::vec3(3, 6, 0));
    EXPECT_NEAR(triangles[0].centroid.x, 1.0f, 1e-6f);
    EXPECT_NEAR(triangles[0].centroid.y, 2.0f, 1e-6f);
    EXPECT_EQ(triangles[1].inputIndex, 1u);
    EXPECT_EQ(triangles[1].box.lower, glm::vec3(-1, -1, -1));
    EXPECT_EQ(triangles[1].box.upper, glm::vec3(2, 2, 5));
}

TEST(Bvh, HalfAreaIsExactAndEmptyBoxesHaveNone) {
    EXPECT_EQ(Box{}.halfArea(), 0.0);
    EXPECT_TRUE(Box{}.isEmpty());
    EXPECT_EQ((Box{glm::vec3(0.0f), glm::vec3(2.0f, 3.0f, 5.0f)}.halfArea()), 6.0 + 15.0 + 10.0);
    const double side = static_cast<double>(1e15f);
    EXPECT_DOUBLE_EQ((Box{glm::vec3(-1e15f), glm::vec3(1e15f)}.halfArea()), 12.0 * side * side);
}

// ---- The checker

/// A tree over four unit triangles at x = 0, 2, 4, 6: two inner levels, four leaves.
struct HandMade {
    std::vector<BuildTriangle> triangles;
    Bvh bvh;

    HandMade() {
        for (std::uint32_t i = 0; i < 4; ++i) {
            const float x = 2.0f * static_cast<float>(i);
            BuildTriangle triangle;
            triangle.box = {{x, 0, 0}, {x + 1, 1, 1}};
            triangle.centroid = {x + 0.5f, 0.5f, 0.5f};
            triangle.inputIndex = i;
            triangles.push_back(triangle);
        }
        const auto box = [](float low, float high) { return Box{{low, 0, 0}, {high, 1, 1}}; };
        bvh.nodes = {{box(0, 7), 1, 0}, {box(0, 3), 3, 0}, {box(4, 7), 5, 0}, {box(0, 1), 0, 1},
                     {box(2, 3), 1, 1}, {box(4, 5), 2, 1}, {box(6, 7), 3, 1}};
        bvh.order = {0, 1, 2, 3};
        bvh.depth = 2;
    }
};

TEST(BvhFault, AHandMadeTreeHasNone) {
    const HandMade tree;
    EXPECT_EQ(findBvhFault(tree.bvh, tree.triangles), "");
    EXPECT_EQ(findBvhFault(Bvh{}, {}), "");
}

TEST(BvhFault, EachPlantedFaultIsFound) {
    const std::pair<const char *, std::function<void(HandMade &)>> faults[] = {
        {"missing triangle", [](HandMade &t) { t.bvh.order.pop_back(); }},
        {"surplus triangle", [](HandMade &t) { t.bvh.order.push_back(0); }},
        {"triangle twice in the order", [](HandMade &t) { t.bvh.order[3] = 2; }},
        {"triangle that is none", [](HandMade &t) { t.bvh.order[1] = 17; }},
        {"leaf past the end", [](HandMade &t) { t.bvh.nodes[6].count = 2; }},
        {"leaf far past the end", [](HandMade &t) { t.bvh.nodes[6].first = 0xFFFFFFFFu; }},
        {"two leaves share a triangle", [](HandMade &t) { t.bvh.nodes[4].first = 0; }},
        {"leaf that misses a triangle",
         [](HandMade &t) {
             t.bvh.nodes.resize(3);
             t.bvh.nodes[1] = {t.bvh.nodes[1].box, 0, 1};
             t.bvh.nodes[2] = {t.bvh.nodes[2].box, 2, 2};
             t.bvh.depth = 1;
         }},
        {"leaf box too small", [](HandMade &t) { t.bvh.nodes[3].box.upper.y = 0.5f; }},
        {"leaf box too high", [](HandMade &t) { t.bvh.nodes[5].box.lower.z = 0.1f; }},
        {"inner box too small", [](HandMade &t) { t.bvh.nodes[2].box.upper.x = 6.5f; }},
        {"root box too small", [](HandMade &t) { t.bvh.nodes[0].box.lower.x = 0.5f; }},
        {"box by one unit in the last place",
         [](HandMade &t) { t.bvh.nodes[6].box.upper.x = std::nextafter(7.0f, 0.0f); }},
        {"leaf box of NaN", [](HandMade &t) { t.bvh.nodes[3].box.lower.x = std::nanf(""); }},
        {"triangles swapped between leaves", [](HandMade &t) { std::swap(t.bvh.order[0], t.bvh.order[3]); }},
        {"child out of range", [](HandMade &t) { t.bvh.nodes[2].first = 6; }},
        {"child far out of range", [](HandMade &t) { t.bvh.nodes[2].first = 0xFFFFFFFFu; }},
        {"cycle", [](HandMade &t) { t.bvh.nodes[2].first = 0; }},
        {"self", [](HandMade &t) { t.bvh.nodes[2].first = 2; }},
        {"shared children", [](HandMade &t) { t.bvh.nodes[2].first = 3; }},
        {"orphan", [](HandMade &t) { t.bvh.nodes.push_back(t.bvh.nodes[6]); }},
        {"empty leaf", [](HandMade &t) { t.bvh.nodes[6].count = 0; }},
        {"depth too small", [](HandMade &t) { t.bvh.depth = 1; }},
        {"depth too large", [](HandMade &t) { t.bvh.depth = 3; }},
        {"no nodes", [](HandMade &t) { t.bvh.nodes.clear(); }},
    };
    for (const auto &[name, plant] : faults) {
        HandMade tree;
        plant(tree);
        EXPECT_NE(findBvhFault(tree.bvh, tree.triangles), "") << name;
    }
}

// ---- Statistics

TEST(BvhStatistics, OfAHandMadeTree) {
    const HandMade tree;
    const BvhStatistics statistics = measureBvh(tree.bvh);
    EXPECT_EQ(statistics.triangleCount, 4u);
    EXPECT_EQ(statistics.innerCount, 3u);
    EXPECT_EQ(statistics.leafCount, 4u);
    EXPECT_EQ(statistics.depth, 2);
    EXPECT_EQ(statistics.largestLeaf, 1u);
    EXPECT_EQ(statistics.meanLeaf, 1.0);
    EXPECT_EQ(statistics.leafHistogram, (std::array<std::size_t, 8>{4, 0, 0, 0, 0, 0, 0, 0}));
    // Half areas: root 7 + 7 + 1 = 15, its children 3 + 3 + 1 = 7, leaves 3.
    EXPECT_DOUBLE_EQ(statistics.sahCost, (nodeCost * (15.0 + 7.0 + 7.0) + triangleCost * 4.0 * 3.0) / 15.0);
    EXPECT_DOUBLE_EQ(statistics.trianglesTested, 4.0 * 3.0 / 15.0);
}

TEST(BvhStatistics, OfNothingAndOfASingleLeaf) {
    const BvhStatistics nothing = measureBvh({});
    EXPECT_EQ(nothing.leafCount, 0u);
    EXPECT_EQ(nothing.sahCost, 0.0);
    EXPECT_EQ(nothing.meanLeaf, 0.0);
    Random random(13);
    const Bvh leaf = buildBvh(
        TreeKind::None, buildTriangles(testing::sceneOf(testing::triangleSoup(random, 9, 1.0, 1.0))), 1);
    const BvhStatistics statistics = measureBvh(leaf);
    EXPECT_EQ(statistics.innerCount, 0u);
    EXPECT_EQ(statistics.leafCount, 1u);
    EXPECT_EQ(statistics.largestLeaf, 9u);
    EXPECT_DOUBLE_EQ(statistics.sahCost, triangleCost * 9.0);
}

TEST(BvhStatistics, LeavesAreCountedUpToPowersOfTwo) {
    // One leaf of each size from 1 to 130, below a root that is not looked at.
    Bvh bvh;
    for (std::uint32_t size = 1; size <= 130; ++size)
        bvh.nodes.push_back({Box{glm::vec3(0.0f), glm::vec3(1.0f)}, 0, size});
    const BvhStatistics statistics = measureBvh(bvh);
    EXPECT_EQ(statistics.leafHistogram, (std::array<std::size_t, 8>{1, 1, 2, 4, 8, 16, 32, 66}));
    EXPECT_EQ(statistics.largestLeaf, 130u);
}

TEST(BvhStatistics, SahIsNotWorseThanMidpointOnTypicalMeshes) {
    Random random(14);
    const std::pair<const char *, TriangleMesh> meshes[] = {
        {"soup", testing::triangleSoup(random, 5000, 1.0, 0.03)},
        {"ball", testing::icosphere(5)},
        {"star", testing::spikyStar()},
        {"small in large",
         [&] {
             TriangleMesh mesh = testing::triangleSoup(random, 3000, 0.1, 0.005);
             testing::addQuad(mesh, {-10, -1, -10}, {0, 0, 20}, {20, 0, 0});
             return mesh;
         }()},
    };
    for (const auto &[name, mesh] : meshes) {
        const std::vector<BuildTriangle> triangles = buildTriangles(testing::sceneOf(mesh));
        for (const int leafSize : {1, 2, 4, 8, 16}) {
            const double midpoint = measureBvh(buildBvh(TreeKind::Midpoint, triangles, leafSize)).sahCost;
            const double sah = measureBvh(buildBvh(TreeKind::Sah, triangles, leafSize)).sahCost;
            fmt::print("    {}, leaf size {}: midpoint {:.2f}, sah {:.2f}\n", name, leafSize, midpoint, sah);
            EXPECT_LE(sah, midpoint) << name << ", leaf size " << leafSize;
        }
    }
}

} // namespace
} // namespace hyalite::core
