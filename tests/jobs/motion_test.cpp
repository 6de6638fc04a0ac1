// Surfaces of a frame by the numbers of primitives.
#include "host/jobs/motion.h"

#include "host/jobs/projection.h"
#include "host/reference/first_hits.h"
#include "host/scene/instances.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <set>

namespace hyalite::core::testing {
namespace {

/// Meshes before and after instances, one of which mirrors, and spheres beside them and in the tree.
TestScene crowdOfMeshes() {
    TestScene scene;
    scene.materials.resize(1);
    scene.camera.position = {0, 0, 5};
    scene.camera.direction = {0, 0, -1};
    scene.camera.width = scene.camera.height = 48;
    for (int i = 0; i < 24; ++i)
        scene.spheres.push_back({{i * 0.1 - 1.2, -1.2, 0}, 0.2, 0, false});
    scene.meshes.push_back(placed(icosphere(1), 0.4, {-1, 0.5, 0}));
    std::vector<Placement> placements(3);
    placements[0].offset = {0.2f, 0.3f, 0};
    placements[1].offset = {1, 0.3f, 0};
    placements[1].rows[0] = {-0.7f, 0.2f, 0};
    placements[2].offset = {0.2f, 1.2f, 0};
    addInstances(scene, placed(icosphere(1), 0.5, {0, 0, 0}), placements);
    scene.meshes.push_back(placed(icosphere(2), 0.4, {-1, 1.3, 0}));
    return scene;
}

TEST(FrameSurfaces, HaveThePointsThatAreHit) {
    const TestScene scene = crowdOfMeshes();
    PackedScene packed = packScene(scene, buildBvh(TreeKind::Sah, scene, 4));
    EXPECT_FALSE(packed.instances.empty());
    const FrameSurfaces surfaces(packed);
    std::set<std::uint32_t> primitives;
    reference::visitFirstHits(packed, {0, 48, 0, 48}, [&](int y, std::span<const reference::FirstHit> hits) {
        for (std::size_t x = 0; x < hits.size(); ++x) {
            const reference::FirstHit &hit = hits[x];
            if (hit.primitive == layout::noPrimitive)
                continue;
            const std::optional<glm::dvec3> point = surfaces.pointOf(hit.primitive, hit.u, hit.v);
            EXPECT_EQ(point.has_value(), hit.primitive >= scene.spheres.size());
            if (point) {
                EXPECT_EQ(*point, hit.position);
            }
            const std::optional<glm::dvec2> pixel = pixelOf(scene.camera, hit.position);
            ASSERT_TRUE(pixel.has_value());
            EXPECT_NEAR(pixel->x, static_cast<double>(x) + 0.5, 1e-3);
            EXPECT_NEAR(pixel->y, y + 0.5, 1e-3);
            primitives.insert(hit.primitive);
        }
    });
    EXPECT_GT(primitives.size(), 150u);
}

TEST(Pixels, AreWhereOtherCamerasShowThem) {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.direction = {0, 0, -2};
    camera.up = {0, 1, 0};
    camera.width = 200;
    camera.height = 100;
    camera.horizontalFovDegrees = 90.0;
    EXPECT_FALSE(pixelOf(camera, {1, 2, 4}).has_value()) << "behind";
    camera.kind = CameraKind::Orthographic;
    camera.viewWidth = 4.0;
    EXPECT_LT(glm::distance(*pixelOf(camera, {2, 2.5, -7}), glm::dvec2(150, 25)), 1e-9);
    EXPECT_LT(glm::distance(*pixelOf(camera, {2, 2.5, 9}), glm::dvec2(150, 25)), 1e-9) << "behind, too";
    camera.kind = CameraKind::Panorama;
    EXPECT_LT(glm::distance(*pixelOf(camera, {1, 2, 0}), glm::dvec2(100, 50)), 1e-9) << "ahead";
    EXPECT_LT(glm::distance(*pixelOf(camera, {5, 2, 3}), glm::dvec2(150, 50)), 1e-9) << "to the right";
    EXPECT_LT(glm::distance(*pixelOf(camera, {1, 3, 2}), glm::dvec2(100, 25)), 1e-9) << "up";
}

} // namespace
} // namespace hyalite::core::testing
