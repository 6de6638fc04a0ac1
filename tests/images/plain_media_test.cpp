// Glass in glass, smooth meshes and long paths: the renderers' mean radiance is that of the plain path tracer.
#include "tests/images/plain_comparison.h"
#include "tests/images/plain_scenes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace hyalite::core {
namespace {

using testing::addBall;
using testing::expectPlainRadiance;

Material glassOf(float index, const glm::vec3 &absorption, int priority = 0, float roughness = 0.0f) {
    Material material;
    material.kind = MaterialKind::Dielectric;
    material.refractiveIndex = index;
    material.absorption = absorption;
    material.priority = priority;
    material.roughness = roughness;
    return material;
}

const testing::Comparison wholeAndParts{.regions = {{0, 16, 0, 16}, {4, 12, 4, 12}, {2, 8, 2, 8}}};

TestScene studio(int maxDepth) {
    TestScene scene = testing::emptyScene(maxDepth);
    scene.environment = testing::studioEnvironment();
    return scene;
}

TEST(PlainGlass, IsTheSameInALiquid) {
    TestScene scene = studio(7);
    addBall(scene, {0.0, 0.0, 0.0}, 1.0, glassOf(1.33f, {0.1f, 0.2f, 0.4f}));
    addBall(scene, {0.1, -0.1, 0.3}, 0.6, glassOf(1.8f, {0.5f, 0.2f, 0.1f}, 1));
    expectPlainRadiance(scene, wholeAndParts);
}

TEST(PlainGlass, IsTheSameWhereItOverlaps) {
    TestScene scene = studio(7);
    addBall(scene, {-0.4, 0.0, 0.0}, 0.7, glassOf(1.3f, {0.6f, 0.1f, 0.1f}, 1));
    addBall(scene, {0.4, 0.1, 0.0}, 0.7, glassOf(2.0f, {0.1f, 0.3f, 0.9f}, 2));
    addBall(scene, {0.0, -0.3, 0.2}, 0.5, glassOf(1.6f, {0.1f, 0.9f, 0.1f}, 1));
    expectPlainRadiance(scene, wholeAndParts);
}

TEST(PlainGlass, IsTheSameAroundABallOfAir) {
    TestScene scene = studio(8);
    addBall(scene, {0.0, 0.0, 0.0}, 1.0, glassOf(1.5f, {0.2f, 0.3f, 0.4f}));
    addBall(scene, {0.0, 0.1, 0.0}, 0.7, glassOf(1.0f, glm::vec3(0.0f), 1));
    expectPlainRadiance(scene, wholeAndParts);
}

TEST(PlainGlass, IsTheSameWhereItIsHollow) {
    TestScene scene = studio(8);
    const Material clear = glassOf(1.5f, {0.2f, 0.3f, 0.4f});
    addBall(scene, {0.0, 0.0, 0.0}, 1.0, clear);
    addBall(scene, {0.0, 0.1, 0.0}, 0.7, clear, true);
    scene.spheres.back().materialIndex = scene.spheres.front().materialIndex;
    expectPlainRadiance(scene, wholeAndParts);
}

TEST(PlainGlass, IsTheSameAroundTheEye) {
    TestScene scene = studio(6);
    scene.camera.position = {0.3, 0.2, 0.4};
    scene.camera.horizontalFovDegrees = 100.0;
    addBall(scene, {0.0, 0.0, 0.0}, 1.0, glassOf(1.5f, {0.2f, 0.3f, 0.4f}));
    expectPlainRadiance(scene, wholeAndParts);
}

TEST(PlainGlass, IsTheSameWhereRoughIsInSmooth) {
    TestScene scene = studio(6);
    addBall(scene, {0.0, 0.0, 0.0}, 1.0, glassOf(1.4f, {0.1f, 0.2f, 0.4f}));
    addBall(scene, {0.1, -0.1, 0.3}, 0.6, glassOf(1.9f, {0.3f, 0.2f, 0.1f}, 1, 0.5f));
    expectPlainRadiance(scene, wholeAndParts);
}

/// A wavy sheet whose normals are those of the wave, seen from the front.
void addWave(TestScene &scene, const Material &material, bool isClockwise = false) {
    TriangleMesh mesh;
    mesh.materialIndex = testing::addMaterial(scene, material);
    const auto index = [](int x, int y) { return static_cast<std::uint32_t>(y * 5 + x); };
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x) {
            const float u = static_cast<float>(x) / 2.0f - 1.0f;
            const float v = static_cast<float>(y) / 2.0f - 1.0f;
            mesh.positions.emplace_back(u, v, 0.15f * std::sin(2.5f * u) * std::cos(2.0f * v));
            mesh.normals.push_back(
                glm::normalize(glm::vec3(-0.375f * std::cos(2.5f * u) * std::cos(2.0f * v),
                                         0.3f * std::sin(2.5f * u) * std::sin(2.0f * v), 1.0f)));
        }
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            glm::uvec3 lower(index(x, y), index(x + 1, y), index(x + 1, y + 1));
            glm::uvec3 upper(index(x, y), index(x + 1, y + 1), index(x, y + 1));
            if (isClockwise) {
                std::swap(lower.y, lower.z);
                std::swap(upper.y, upper.z);
            }
            mesh.triangles.push_back({lower, lower});
            mesh.triangles.push_back({upper, upper});
        }
    scene.meshes.push_back(mesh);
}

class PlainMeshes : public ::testing::TestWithParam<MaterialKind> {};

INSTANTIATE_TEST_SUITE_P(All, PlainMeshes,
                         ::testing::Values(MaterialKind::Diffuse, MaterialKind::Mirror,
                                           MaterialKind::Dielectric, MaterialKind::Conductor,
                                           MaterialKind::Principled));

TEST_P(PlainMeshes, IsTheSameWithItsNormals) {
    TestScene scene = studio(3);
    scene.camera.horizontalFovDegrees = 25.0;
    Material material;
    material.kind = GetParam();
    material.roughness = material.kind == MaterialKind::Dielectric ? 0.0f : 0.5f;
    addWave(scene, material);
    testing::Comparison comparison = wholeAndParts;
    comparison.allowance = testing::energyAllowance;
    expectPlainRadiance(scene, comparison);
}

// Normals, not the order of corners, say where the front is.
TEST(PlainMesh, FacesWhereItsNormalsPoint) {
    TestScene scene = studio(2);
    scene.camera.horizontalFovDegrees = 25.0;
    addWave(scene, testing::diffuse({0.8f, 0.6f, 0.4f}), true);
    expectPlainRadiance(scene, wholeAndParts);
}

// A clear coat is on the front only; what is two-sided is lit from where it is seen.
TEST(PlainMesh, IsTheSameFromBehind) {
    TestScene scene = studio(2);
    Material paint = testing::diffuse({0.7f, 0.5f, 0.3f});
    paint.kind = MaterialKind::Principled;
    paint.roughness = 0.5f;
    paint.clearcoat = 1.0f;
    paint.clearcoatRoughness = 0.4f;
    paint.twoSided = true;
    testing::addQuad(scene, {-1.0f, -1.0f, 0.0f}, {0.0f, 2.0f, 0.0f}, {2.0f, 0.0f, 0.3f}, paint);
    testing::Comparison comparison = wholeAndParts;
    comparison.allowance = testing::energyAllowance;
    expectPlainRadiance(scene, comparison);
}

// Russian roulette begins at the fourth segment, in glass too.
TEST(PlainLongPaths, AreTheSame) {
    TestScene scene = studio(9);
    scene.camera.horizontalFovDegrees = 40.0;
    testing::addQuad(scene, {-3.0f, -0.6f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f},
                     testing::diffuse({0.8f, 0.6f, 0.4f}));
    addBall(scene, {-0.7, 0.0, 0.0}, 0.6, glassOf(1.5f, {0.2f, 0.3f, 0.4f}));
    Material metal;
    metal.kind = MaterialKind::Conductor;
    metal.roughness = 0.3f;
    addBall(scene, {0.6, 0.0, 0.0}, 0.6, metal);
    Material mirror;
    mirror.kind = MaterialKind::Mirror;
    testing::addQuad(scene, {-2.0f, -0.6f, -1.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}, mirror);
    testing::Comparison comparison = wholeAndParts;
    comparison.allowance = testing::energyAllowance;
    expectPlainRadiance(scene, comparison);
}

} // namespace
} // namespace hyalite::core
