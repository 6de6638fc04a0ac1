// The order of triangles with instances, and what is flattened.
#include "host/scene/instances.h"

#include "host/base/error.h"
#include "tests/fixtures/geometry_fixture.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

Placement movedBy(float x) {
    Placement placement;
    placement.offset.x = x;
    return placement;
}

Placement mirroredAt(float x) {
    Placement placement = movedBy(x);
    placement.rows[0].x = -1.0f;
    return placement;
}

/// A mesh, two places of a second one, another mesh, and one place of a third one.
Scene fiveMeshes() {
    Scene scene = testing::sceneOf(testing::tetrahedron());
    addInstances(scene, testing::gridCube(1), std::array{movedBy(10.0f), movedBy(20.0f)});
    scene.meshes.push_back(testing::tetrahedron());
    addInstances(scene, testing::icosphere(0), std::array{movedBy(30.0f)});
    return scene;
}

TEST(InputOrder, CountsInstancesAsMeshes) {
    const InputOrder order = inputOrder(fiveMeshes());
    EXPECT_EQ(order.meshes, (std::vector<std::uint32_t>{0, 28}));
    EXPECT_EQ(order.instances, (std::vector<std::uint32_t>{4, 16, 32}));
    EXPECT_EQ(order.triangleCount, 52u);
}

TEST(InputOrder, StaysWhereInstancesBecomeMeshes) {
    Scene needed = fiveMeshes();
    arrangeInstances(needed, Flattening::Needed);
    EXPECT_EQ(needed.meshes.size(), 3u); // with the mesh that has one place
    EXPECT_EQ(needed.instances.size(), 2u);
    EXPECT_EQ(inputOrder(needed).meshes, (std::vector<std::uint32_t>{0, 28, 32}));
    EXPECT_EQ(inputOrder(needed).instances, (std::vector<std::uint32_t>{4, 16}));

    Scene all = fiveMeshes();
    arrangeInstances(all, Flattening::All);
    ASSERT_EQ(all.meshes.size(), 5u);
    EXPECT_TRUE(all.instances.empty() && all.prototypes.empty());
    EXPECT_EQ(inputOrder(all).meshes, (std::vector<std::uint32_t>{0, 4, 16, 28, 32}));
    EXPECT_EQ(all.meshes[2].positions[0].x, testing::gridCube(1).positions[0].x + 20.0f);
    arrangeInstances(needed, Flattening::All);
    EXPECT_EQ(needed.meshes.size(), 5u);
}

TEST(Instances, ThatEmitLightBecomeMeshes) {
    Scene scene = fiveMeshes();
    scene.materials[0].emission = glm::vec3(1.0f);
    arrangeInstances(scene, Flattening::Needed);
    EXPECT_TRUE(scene.instances.empty());
}

TEST(Instances, ThatAreNearlyFlatBecomeMeshes) {
    Scene scene = testing::sceneOf(testing::tetrahedron());
    Placement flat = movedBy(1.0f);
    flat.rows[0].x = 1e-20f;
    addInstances(scene, testing::gridCube(1), std::array{movedBy(2.0f), flat, movedBy(3.0f)});
    arrangeInstances(scene, Flattening::Needed);
    EXPECT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.meshes.size(), 2u);
}

// Corners are counter-clockwise seen from outside, and normals point there, however a closed mesh is placed.
TEST(Instances, KeepTheirOutsideWhereTheyAreMirrored) {
    TriangleMesh ball = testing::icosphere(1);
    ball.normals = ball.positions;
    for (MeshTriangle &triangle : ball.triangles)
        triangle.normals = triangle.positions;
    Scene scene;
    scene.materials.push_back({});
    addInstances(scene, ball, std::array{movedBy(0.0f), mirroredAt(0.0f), mirroredAt(5.0f)});
    EXPECT_EQ(scene.prototypes.size(), 2u);
    arrangeInstances(scene, Flattening::All);
    ASSERT_EQ(scene.meshes.size(), 3u);
    for (const TriangleMesh &mesh : scene.meshes) {
        const glm::vec3 centre(&mesh == &scene.meshes[2] ? 5.0f : 0.0f, 0.0f, 0.0f);
        for (const MeshTriangle &triangle : mesh.triangles) {
            const glm::vec3 a = mesh.positions[triangle.positions.x] - centre;
            const glm::vec3 b = mesh.positions[triangle.positions.y] - centre;
            const glm::vec3 c = mesh.positions[triangle.positions.z] - centre;
            EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a), 0.0f);
            EXPECT_NEAR(glm::dot(mesh.normals[triangle.normals.x], a), 1.0f, 1e-5f);
        }
    }
}

TEST(Instances, BecomeMeshesWhileThereIsRoom) {
    Scene scene = fiveMeshes();
    addInstances(scene, testing::icosphere(4),
                 std::vector<Placement>(2000, movedBy(1.0f))); // 10 million triangles
    addInstances(scene, testing::icosphere(1), std::vector<Placement>(3, movedBy(2.0f)));
    const Arrangement needed{2 + 1 + 2000 + 3, 4, 1};
    Scene kept = scene;
    EXPECT_EQ(arrangeInstances(kept, Flattening::Needed), needed);
    const Arrangement fitting{2 + 1 + 2000 + 3, 4, 2 + 1 + 3};
    EXPECT_EQ(arrangeInstances(scene, Flattening::Fitting), fitting);
    EXPECT_EQ(scene.instances.size(), 2000u);
    EXPECT_EQ(scene.prototypes.size(), 1u);
    EXPECT_EQ(inputOrder(scene).triangleCount, inputOrder(kept).triangleCount);
}

TEST(Instances, AreRefusedAsMeshesWhereThereAreTooMany) {
    Scene scene;
    scene.materials.push_back({});
    addInstances(scene, testing::icosphere(4), std::vector<Placement>(300'000, movedBy(1.0f)));
    EXPECT_THROW(arrangeInstances(scene, Flattening::All), Error);
    EXPECT_NO_THROW(arrangeInstances(scene, Flattening::Needed));
}

} // namespace
} // namespace hyalite::core
