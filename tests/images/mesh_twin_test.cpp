// The device's image and the CPU twin's are equal bit for bit on meshes that are hard on float32, for every kernel and
// every tree.
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::renderOnCpu;
using testing::renderOnDevice;

/// Looks at the origin, or at `target`, from `position`. One light stands beside the camera, another one above.
TestScene lookingAt(const glm::dvec3 &target, const glm::dvec3 &position, double fovDegrees,
                    TriangleMesh mesh) {
    TestScene scene(testing::sceneOf(std::move(mesh)));
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

/// A picture with fewer shadow rays than `minShadowRays` shows too little of the mesh to test anything.
void expectTwins(TestScene scene, std::uint64_t minShadowRays) {
    for (const TreeKind tree : {TreeKind::Midpoint, TreeKind::Sah}) {
        scene.settings.tree = tree;
        const reference::Result cpu = renderOnCpu(scene);
        EXPECT_GE(cpu.rays.shadow, minShadowRays);
        for (const char *kernel : {"stack", "skip-list-x2"}) {
            const gpu::Result device = renderOnDevice(scene, {.kernel = gpu::findKernel(kernel)});
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
    TestScene scene = lookingAt({1, 0.5, 0.2}, {0.1, 0.2, -0.3}, 90.0, testing::icosphere(3));
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
    TestScene scene = lookingAt({}, {0.3, 0.8, 2.5}, 60.0, walls);
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

/// Adds a copy of `shape`, scaled and moved.
void addCopy(TriangleMesh &mesh, const TriangleMesh &shape, double scale, const glm::dvec3 &offset) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3 &position : shape.positions)
        mesh.positions.emplace_back(scale * glm::dvec3(position) + offset);
    for (const MeshTriangle &triangle : shape.triangles)
        mesh.triangles.push_back({triangle.positions + first, triangle.normals});
}

/// Expects twins, and of each tree the picture that there is without one.
void expectTwinsAsWithoutTree(TestScene scene, std::uint64_t minShadowRays) {
    scene.settings.tree = TreeKind::None;
    const Film plain = renderOnCpu(scene).film;
    for (const TreeKind tree : {TreeKind::Midpoint, TreeKind::Sah}) {
        scene.settings.tree = tree;
        EXPECT_EQ(differingPixels(renderOnCpu(scene).film, plain), 0u);
    }
    expectTwins(scene, minShadowRays);
}

TestScene smallPicture(TestScene scene) {
    scene.camera.width = 24;
    scene.camera.height = 20;
    scene.settings.samplesPerPixel = 1;
    return scene;
}

// No split can tell them apart: a ray that meets one is tested against all of them.
TEST(UglyMeshTwins, AgreeOnIdenticalTriangles) {
    TriangleMesh pile;
    pile.positions = {{-1, -1, 0}, {1, -1, 0.1f}, {0, 1, -0.1f}};
    pile.triangles.resize(500, {{0, 1, 2}, glm::uvec3(MeshTriangle::noNormal)});
    expectTwinsAsWithoutTree(smallPicture(lookingAt({}, {0.5, 0.4, 3}, 40.0, pile)), 100);
}

// Each is half as large as the one around it, down to denormal numbers; midpoints cut off one at a time.
TEST(UglyMeshTwins, AgreeOnNestedTriangles) {
    TriangleMesh shape, nest;
    testing::addQuad(shape, {0, 0, 0}, {1, 0, 0.2f}, {0, 1, 0.1f});
    for (int level = 0; level < 150; ++level)
        addCopy(nest, shape, std::ldexp(1.0, -level), {0, 0, std::ldexp(0.5, -level)});
    expectTwinsAsWithoutTree(smallPicture(lookingAt({0.2, 0.2, 0}, {0.5, 0.6, 2}, 40.0, nest)), 100);
}

TEST(UglyMeshTwins, AgreeOnAGiantAmongTheTiny) {
    TriangleMesh mesh = soup(1e-3, {});
    addCopy(mesh, testing::placed(testing::gridCube(1), 1e9, {0, 0, -1.2e9}), 1.0, {});
    expectTwins(smallPicture(lookingAt({}, {1e-3, 2e-3, 3e-3}, 60.0, mesh)), 400);
}

TEST(UglyMeshTwins, AgreeOnTrianglesWithoutArea) {
    testing::Random random(302);
    TriangleMesh mesh = testing::triangleSoup(random, 300, 1.0, 0.3);
    for (std::size_t i = 0; i < mesh.triangles.size();
         i += 2) // a point, a doubled edge, three corners on a line
        for (glm::length_t corner = 1; corner < 3; ++corner) {
            const glm::vec3 &first = mesh.positions[mesh.triangles[i].positions[0]];
            glm::vec3 &position = mesh.positions[mesh.triangles[i].positions[corner]];
            if (i % 3 == 0 || (i % 3 == 1 && corner == 1))
                position = first;
            else if (i % 3 == 2)
                position = first + glm::vec3(0.25f * static_cast<float>(corner), 0, 0);
        }
    expectTwinsAsWithoutTree(smallPicture(lookingAt({}, {1, 2, 3}, 40.0, mesh)), 50);
    for (MeshTriangle &triangle : mesh.triangles)
        triangle.positions = glm::uvec3(triangle.positions.x);
    EXPECT_EQ(renderOnCpu(smallPicture(lookingAt({}, {1, 2, 3}, 40.0, mesh))).rays.shadow, 0u);
}

TEST(UglyMeshTwins, AgreeAtTheEndsOfTheRangeOfCoordinates) {
    testing::Random random(303);
    const TriangleMesh mesh = testing::triangleSoup(random, 300, 1.0, 0.3);
    for (const double scale : {1e13, 1e-15})
        expectTwins(
            smallPicture(lookingAt({}, glm::dvec3(1, 2, 3) * scale, 40.0, testing::placed(mesh, scale, {}))),
            0);
}

} // namespace
} // namespace hyalite::core
