#include "host/bvh/joined_triangles.h"

#include "host/bvh/tree_statistics.h"
#include "tests/fixtures/geometry_fixture.h"

#include <omp.h>

#include <algorithm>

namespace hyalite::core {
namespace {

/// A strip of `count` quads, of two triangles each.
TriangleMesh stripOfQuads(int count) {
    TriangleMesh mesh;
    for (int i = 0; i < count; ++i)
        testing::addQuad(mesh, glm::vec3(static_cast<float>(i), 0.0f, 0.0f), {1, 0, 0}, {0, 1, 0});
    return mesh;
}

std::vector<std::uint32_t> indicesOf(std::span<const BuildTriangle> items) {
    std::vector<std::uint32_t> indices;
    for (const BuildTriangle &item : items)
        indices.push_back(item.inputIndex);
    return indices;
}

std::vector<std::uint32_t> joinedIndices(const Scene &scene, std::vector<BuildTriangle> items) {
    const JoinedItems isJoined = joinTriangles(scene.meshes, items);
    std::vector<std::uint32_t> joined;
    for (const BuildTriangle &item : items)
        if (isPair(isJoined, item))
            joined.push_back(item.inputIndex);
    return joined;
}

TEST(JoinedTriangles, AreTheHalvesOfQuads) {
    const Scene scene = testing::sceneOf(stripOfQuads(3));
    std::vector<BuildTriangle> items = buildTriangles(scene);
    const std::vector<BuildTriangle> single = items;
    const JoinedItems isJoined = joinTriangles(scene.meshes, items);
    ASSERT_EQ(indicesOf(items), (std::vector<std::uint32_t>{0, 2, 4}));
    for (const BuildTriangle &item : items) {
        EXPECT_TRUE(isPair(isJoined, item));
        Box both = single[item.inputIndex].box;
        both.extend(single[item.inputIndex + 1].box);
        EXPECT_EQ(item.box.lower, both.lower);
        EXPECT_EQ(item.box.upper, both.upper);
        EXPECT_EQ(item.centroid, (both.lower + both.upper) / 2.0f);
    }
}

TEST(JoinedTriangles, FollowEachOtherInAMeshAndFaceOneSide) {
    // What is between them, or what they lack in common, keeps them apart.
    Scene scene = testing::sceneOf(stripOfQuads(4));
    EXPECT_EQ(joinedIndices(scene, buildTriangles(scene)), (std::vector<std::uint32_t>{0, 2, 4, 6}));
    std::vector<BuildTriangle> items = buildTriangles(scene);
    items.erase(items.begin() + 3); // a duplicate of another, say
    EXPECT_EQ(joinedIndices(scene, items), (std::vector<std::uint32_t>{0, 4, 6}));
    TriangleMesh &mesh = scene.meshes[0];
    std::swap(mesh.triangles[0].positions.x, mesh.triangles[0].positions.y); // turned inside out
    EXPECT_EQ(joinedIndices(scene, buildTriangles(scene)), (std::vector<std::uint32_t>{2, 4, 6}));
    scene.materials.push_back({});
    mesh.triangleMaterials = {0, 0, 0, 1, 0, 0, 1, 1};
    EXPECT_EQ(joinedIndices(scene, buildTriangles(scene)), (std::vector<std::uint32_t>{4, 6}));
    TriangleMesh rest = mesh; // a quad's halves in two meshes
    mesh.triangles.resize(5);
    rest.triangles.erase(rest.triangles.begin(), rest.triangles.begin() + 5);
    rest.triangleMaterials = {0, 1, 1};
    scene.meshes.push_back(rest);
    EXPECT_EQ(joinedIndices(scene, buildTriangles(scene)), (std::vector<std::uint32_t>{6}));
}

TEST(JoinedTriangles, AreNoneWhereNoEdgeIsShared) {
    testing::Random random(51);
    const Scene scene = testing::sceneOf(testing::triangleSoup(random, 100, 1.0, 0.1));
    std::vector<BuildTriangle> items = buildTriangles(scene);
    EXPECT_TRUE(joinTriangles(scene.meshes, items).empty());
    EXPECT_EQ(items.size(), 100u);
}

TEST(JoinedTriangles, HaveALeafOfTheirOwnInSoundTreesForAnyNumberOfThreads) {
    TriangleMesh mesh = testing::icosphere(5); // 20480 triangles
    for (const glm::vec3 &corner : {glm::vec3(3, 0, 0), glm::vec3(3, 1, 0), glm::vec3(4, 0, 0)})
        testing::addQuad(mesh, corner, {1, 0, 0}, {0, 0.5f, 0});
    const Scene scene = testing::sceneOf(mesh);
    const std::vector<BuildTriangle> triangles = buildTriangles(scene);
    std::vector<BuildTriangle> items = triangles;
    const JoinedItems isJoined = joinTriangles(scene.meshes, items);
    ASSERT_LT(items.size(), triangles.size() * 4 / 5);
    const int threadCountBefore = omp_get_max_threads();
    std::vector<std::uint32_t> firstOrder;
    for (const int threadCount : {1, 3}) {
        omp_set_num_threads(threadCount);
        const Bvh bvh = buildBvh(TreeKind::Sah, scene, 8);
        EXPECT_EQ(findBvhFault(bvh, triangles), "");
        std::size_t pairCount = 0;
        for (const BvhNode &node : bvh.nodes) {
            if (!node.isLeaf())
                continue;
            const std::uint32_t first = bvh.order[node.first];
            const bool isOne = isJoined[first];
            pairCount += isOne;
            if (isOne) {
                ASSERT_EQ(node.count, 2u);
                EXPECT_EQ(bvh.order[node.first + 1], first + 1);
            }
        }
        EXPECT_EQ(pairCount, triangles.size() - items.size());
        if (firstOrder.empty())
            firstOrder = bvh.order;
        EXPECT_EQ(bvh.order, firstOrder);
    }
    omp_set_num_threads(threadCountBefore);
    for (const BvhNode &node : buildBvh(TreeKind::Sah, scene, 1).nodes)
        EXPECT_LE(node.count, 1u);
}

} // namespace
} // namespace hyalite::core
