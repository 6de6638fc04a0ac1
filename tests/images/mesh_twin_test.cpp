// The device's image and the CPU twin's are equal bit for bit on meshes that are hard on float32, for every kernel and
// every tree.
#include "tests/images/rendering.h"
#include "tests/unit/geometry_fixture.h"

#include <gtest/gtest.h>

namespace hyalite {
namespace {

using testing::differingPixels;
using testing::renderOnCpu;
using testing::renderOnDevice;

/// Looks at the origin, or at `target`, from `position`. One light stands beside the camera, another one above.
Scene lookingAt(const glm::dvec3 &target, const glm::dvec3 &position, double fovDegrees, TriangleMesh mesh) {
    Scene scene = testing::sceneOf(std::move(mesh));
    scene.materials[0].twoSided = true;
    scene.camera.position = position;
    scene.camera.direction = target - position;
    scene.camera.up = {0.1, 1.0, 0.2};
    scene.camera.horizontalFovDegrees = fovDegrees;
    scene.camera.width = 48;
    scene.camera.height = 40;
    scene.settings.samplesPerPixel = 2;
    scene.background = {0.1f, 0.2f, 0.4f};
    const double distance = glm::length(scene.camera.direction);
    scene.lights.push_back(
        {position + glm::dvec3(0.1, 0.2, 0.0) * distance, glm::dvec3(100.0 * distance * distance)});
    scene.lights.push_back(
        {target + glm::dvec3(0.3, 0.9, -0.1) * distance, glm::dvec3(50.0 * distance * distance)});
    return scene;
}

/// A picture with fewer shadow rays than `leastShadowRays` shows too little of the mesh to test anything.
void expectTwins(Scene scene, std::uint64_t leastShadowRays) {
    for (const TreeKind tree : {TreeKind::Midpoint, TreeKind::Sah}) {
        scene.settings.tree = tree;
        const reference::Result cpu = renderOnCpu(scene);
        EXPECT_GE(cpu.rays.shadow, leastShadowRays);
        for (const gpu::Traversal traversal : {gpu::Traversal::Stack, gpu::Traversal::SkipList}) {
            const gpu::Result device = renderOnDevice(scene, {.traversal = traversal});
            EXPECT_EQ(differingPixels(device.film, cpu.film), 0u);
            EXPECT_EQ(device.rays, cpu.rays);
        }
    }
}

TriangleMesh soup(double scale, const glm::dvec3 &offset) {
    testing::Random random(301);
    return testing::placed(testing::triangleSoup(random, 3000, 1.0, 0.15), scale, offset);
}

TEST(MeshTwins, AgreeFarFromTheOrigin) {
    const glm::dvec3 offset(1e5, -1e5, 3e4);
    expectTwins(lookingAt(offset, offset + glm::dvec3(15, 20, 30), 40.0, soup(10.0, offset)), 2000);
}

// Here the rounding of a ray is far wider than the cells of the skip list's grid, and edges lie in the faces of boxes.
TEST(MeshTwins, AgreeFromFarAway) {
    expectTwins(lookingAt({}, {9e3, 5e3, 7e3}, 0.01, testing::gridCube(16)), 2000);
}

TEST(MeshTwins, AgreeOnTinyMeshes) {
    expectTwins(lookingAt({}, {2e-4, 1e-4, -2e-4}, 40.0, soup(1e-4, {})), 2000);
}

TEST(MeshTwins, AgreeWithTheCameraOnAVertex) {
    const TriangleMesh mesh = soup(1.0, {});
    expectTwins(lookingAt({}, mesh.positions[1000], 100.0, mesh), 2000);
}

TEST(MeshTwins, AgreeWithTheCameraInsideOfGlass) {
    Scene scene = lookingAt({1, 0.5, 0.2}, {0.1, 0.2, -0.3}, 90.0, testing::icosphere(3));
    scene.materials[0].kind = MaterialKind::Dielectric;
    scene.materials[0].segmentTint = {0.95f, 0.9f, 0.98f};
    scene.materials.push_back({});
    scene.spheres.push_back({{0, -1000, 0}, 998.0, 1, false});
    scene.shadowThroughGlass = 0.7f;
    expectTwins(scene, 2000);
}

TEST(MeshTwins, AgreeThatOfTrianglesThatCoincideTheFirstIsSeen) {
    TriangleMesh walls;
    testing::addQuad(walls, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    testing::addQuad(walls, {-1, -1, 1}, {2, 0, 0}, {0, 0, -1});
    testing::addQuad(walls, {-0.9f, -1, 1}, {0.3f, 0.4f, -1}, {0, 1, 0.1f});
    Scene scene = lookingAt({}, {0.3, 0.8, 2.5}, 60.0, walls);
    scene.materials[0].albedo = {0.9f, 0.2f, 0.1f};
    const Film first = renderOnCpu(scene).film;
    scene.materials.push_back({});
    for (int copy = 0; copy < 9; ++copy) {
        scene.meshes.push_back(walls);
        scene.meshes.back().materialIndex = 1;
    }
    EXPECT_EQ(differingPixels(renderOnCpu(scene).film, first), 0u);
    for (const int leafSize : {1, 8}) {
        scene.settings.leafSize = leafSize;
        expectTwins(scene, 2000);
    }
}

} // namespace
} // namespace hyalite
