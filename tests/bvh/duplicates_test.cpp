#include "host/bvh/duplicates.h"

#include "host/bvh/tree_statistics.h"
#include "host/reference/closest_hit.h"
#include "tests/fixtures/geometry_fixture.h"

#include <omp.h>

#include <algorithm>
#include <set>

namespace hyalite::core {
namespace {

using testing::Random;

constexpr TreeKind allKinds[] = {TreeKind::None, TreeKind::Midpoint, TreeKind::Sah};

std::vector<std::uint32_t> indicesOf(std::span<const BuildTriangle> triangles) {
    std::vector<std::uint32_t> indices;
    for (const BuildTriangle &triangle : triangles)
        indices.push_back(triangle.inputIndex);
    return indices;
}

std::set<std::uint32_t> keptIn(const Bvh &bvh) { return {bvh.order.begin(), bvh.order.end()}; }

/// A soup in which half of the triangles come again, from one to `most` times, anywhere; in two meshes that share
/// corners and a material. Some come again turned, turned inside out, or in another material: those stay.
Scene sceneWithCopies(Random &random, std::size_t count, int most) {
    Scene scene = testing::sceneOf(testing::triangleSoup(random, count, 1.0, 0.3));
    scene.materials.push_back({});
    TriangleMesh &mesh = scene.meshes[0];
    const std::vector<MeshTriangle> originals = mesh.triangles;
    for (std::size_t i = 0; i < originals.size(); i += 2) {
        const auto copyCount = static_cast<std::size_t>(random.uniform(1.0, most + 1.0));
        for (std::size_t copy = 0; copy < copyCount; ++copy)
            mesh.triangles.insert(mesh.triangles.begin() +
                                      static_cast<std::ptrdiff_t>(
                                          random.uniform(0.0, static_cast<double>(mesh.triangles.size()))),
                                  originals[i]);
        const glm::uvec3 &corners = originals[i].positions;
        mesh.triangles.push_back({{corners.y, corners.z, corners.x}});
        mesh.triangles.push_back({{corners.x, corners.z, corners.y}});
    }
    TriangleMesh second = mesh;
    for (std::size_t i = 0; i < second.triangles.size(); ++i)
        second.triangleMaterials.push_back(i % 3 == 0 ? 1u : 0u);
    scene.meshes.push_back(second);
    return scene;
}

/// What stays, found in the plainest way.
std::set<std::uint32_t> distinctIndices(const Scene &scene) {
    std::set<std::vector<float>> seen; // no zeros among them, which may be of two signs
    std::set<std::uint32_t> kept;
    std::uint32_t index = 0;
    for (const TriangleMesh &mesh : scene.meshes)
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i, ++index) {
            std::vector<float> key{static_cast<float>(mesh.materialOf(i))};
            for (int corner = 0; corner < 3; ++corner)
                for (int axis = 0; axis < 3; ++axis)
                    key.push_back(mesh.positions[mesh.triangles[i].positions[corner]][axis]);
            if (seen.insert(key).second)
                kept.insert(index);
        }
    return kept;
}

TEST(Duplicates, TheFirstOfEachStaysAndTheOrderWithIt) {
    Scene scene = testing::sceneOf({});
    TriangleMesh &mesh = scene.meshes[0];
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, 0}, {0, 0, 0}};
    const MeshTriangle a{{0, 1, 2}};
    const MeshTriangle turned{{1, 2, 0}};
    const MeshTriangle otherZero{{3, 1, 2}};
    const MeshTriangle otherCorner{{4, 1, 2}}; // of the same place
    mesh.triangles = {turned, a, otherZero, a, otherCorner, turned, a};
    std::vector<BuildTriangle> items = buildTriangles(scene);
    items.push_back({items[1].box, items[1].centroid, 7}); // a sphere, say, or an instance
    dropDuplicates(scene, items);
    EXPECT_EQ(indicesOf(items), (std::vector<std::uint32_t>{0, 1, 2, 7}));
}

TEST(Duplicates, NoTreeHasThemAndWhichTheyAreDoesNotDependOnTheTree) {
    Random random(32);
    for (const int most : {1, 40, 700}) {
        const Scene scene = sceneWithCopies(random, 60, most);
        const std::vector<BuildTriangle> triangles = buildTriangles(scene);
        const std::set<std::uint32_t> expected = distinctIndices(scene);
        ASSERT_LT(expected.size(), triangles.size());
        for (const TreeKind kind : allKinds)
            for (const int leafSize : {1, 3, 8, 64}) {
                SCOPED_TRACE(fmt::format("seed {}, up to {} copies, kind {}, leaf size {}", random.seed(),
                                         most, static_cast<int>(kind), leafSize));
                const Bvh bvh = buildBvh(kind, scene, leafSize);
                EXPECT_EQ(keptIn(bvh), expected);
                EXPECT_EQ(findBvhFault(bvh, triangles, triangles.size() - expected.size()), "");
            }
    }
}

TEST(Duplicates, WithoutThemEachRayMeetsTheSameTriangle) {
    Random random(33);
    const Scene scene = sceneWithCopies(random, 100, 9);
    const PackedScene whole = testing::packed(scene);
    for (const TreeKind kind : allKinds) {
        const PackedScene thinned = packScene(scene, buildBvh(kind, scene, 4));
        ASSERT_LT(thinned.triangles.size(), whole.triangles.size());
        int hitCount = 0;
        for (int i = 0; i < 5000; ++i) {
            const reference::Ray<float> ray{glm::vec3(random.inCube(2.0)), glm::vec3(random.direction())};
            const reference::Hit<float> hit = reference::closestHit(thinned, ray);
            const reference::Hit<float> expected = reference::closestHit(whole, ray);
            hitCount += expected.primitive != layout::noPrimitive;
            ASSERT_EQ(hit.primitive, expected.primitive) << random.seed();
            ASSERT_EQ(hit.distance, expected.distance);
            ASSERT_EQ(hit.u, expected.u);
            ASSERT_EQ(hit.v, expected.v);
        }
        EXPECT_GT(hitCount, 200);
    }
}

TEST(Duplicates, ThePackedSceneAndItsHashAreThoseOfTheFirstOnes) {
    Random random(34);
    Scene scene = sceneWithCopies(random, 50, 30);
    for (Material &material : scene.materials)
        material.emission = glm::vec3(1.0f);
    const std::set<std::uint32_t> expected = distinctIndices(scene);
    std::set<std::uint64_t> hashes;
    for (const TreeKind kind : allKinds) {
        const PackedScene packed = packScene(scene, buildBvh(kind, scene, 8));
        std::set<std::uint32_t> indices;
        for (const layout::TriangleRecord &triangle : packed.triangles)
            indices.insert(triangle.primitiveId - layout::minFirstTriangleId);
        EXPECT_EQ(indices, expected);
        EXPECT_EQ(packed.emitters.size(), expected.size());
        EXPECT_TRUE(std::ranges::is_sorted(packed.emitters, {}, [&](const layout::EmitterRecord &emitter) {
            return packed.triangles[emitter.record].primitiveId;
        }));
        hashes.insert(packed.contentHash());
    }
    EXPECT_EQ(hashes.size(), 1u);
}

TEST(Duplicates, AMillionCopiesOfOneAreOneLeafForAnyNumberOfThreads) {
    Scene scene = testing::sceneOf({});
    TriangleMesh &mesh = scene.meshes[0];
    mesh.positions = {{1, 2, 3}, {2, 2, 3}, {1, 3, 3.5f}};
    mesh.triangles.assign(1'000'000, {{0, 1, 2}});
    const int threadCountBefore = omp_get_max_threads();
    for (const int threadCount : {1, 3}) {
        omp_set_num_threads(threadCount);
        for (const TreeKind kind : allKinds) {
            const Bvh bvh = buildBvh(kind, scene, 1);
            ASSERT_EQ(bvh.nodes.size(), 1u);
            EXPECT_EQ(bvh.nodes[0].count, 1u);
            EXPECT_EQ(bvh.order, (std::vector<std::uint32_t>{0}));
        }
    }
    omp_set_num_threads(threadCountBefore);
}

TEST(Duplicates, AMeshWithoutThemHasTheTreeThatItAlwaysHad) {
    // None of these has an edge in common with the next one, so that no pairs are made either.
    Random random(35);
    TriangleMesh
        alike; // of one centroid and box, so that duplicates are looked for; none is the image of another
    for (int i = 1; i <= 500; ++i) {
        const float x = 1e-20f * static_cast<float>(i);
        testing::addTriangle(alike, {-1, -1, -1}, {x, 0, x}, {1, 1, 1});
    }
    for (const TriangleMesh &mesh : {testing::triangleSoup(random, 3000, 1.0, 0.05), alike}) {
        const Scene scene = testing::sceneOf(mesh);
        for (const TreeKind kind : allKinds) {
            const Bvh bvh = buildBvh(kind, scene, 4);
            const Bvh expected = buildBvh(kind, buildTriangles(scene), 4);
            EXPECT_EQ(bvh.order, expected.order);
            EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(bvh.nodes)),
                                           std::as_bytes(std::span(expected.nodes))));
        }
    }
}

TEST(Duplicates, OfCutOutMaterialsShowOtherPartsOfTheImage) {
    Scene scene;
    TriangleMesh &mesh = scene.meshes.emplace_back();
    for (int i = 0; i < 3; ++i)
        testing::addTriangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
    mesh.triangleUvs = {{0, 1, 2}, {1, 0, 2}, {0, 1, 2}};
    scene.materials.resize(1);
    EXPECT_EQ(keptIn(buildBvh(TreeKind::Sah, scene, 4)), (std::set<std::uint32_t>{0}));
    scene.textures.resize(1);
    scene.materials[0].textures[layout::slotOpacity] = TextureUse{};
    EXPECT_EQ(keptIn(buildBvh(TreeKind::Sah, scene, 4)), (std::set<std::uint32_t>{0, 1}));
}

} // namespace
} // namespace hyalite::core
