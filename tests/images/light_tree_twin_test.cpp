// Scenes whose lights are chosen by the light tree have one picture, for every kernel and on both renderers.
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::renderOnCpu;
using testing::renderOnDevice;

/// Lamps of every kind above a floor and, if `isRough`, a ball of rough glass.
TestScene lampShop(std::uint64_t seed, bool isRough) {
    testing::Random random(seed);
    TestScene scene;
    scene.materials.resize(4);
    scene.materials[1].emission = {6.0f, 5.0f, 4.0f};
    scene.materials[2].emission = {2.0f, 3.0f, 9.0f};
    scene.materials[2].twoSided = true;
    scene.materials[3].kind = isRough ? MaterialKind::Dielectric : MaterialKind::Mirror;
    scene.materials[3].refractiveIndex = 1.5f;
    scene.materials[3].roughness = isRough ? 0.4f : 0.0f;
    for (int i = 0; i < 30; ++i) {
        const glm::dvec3 place = random.inCube(5.0) + glm::dvec3(0, 3, 0);
        scene.spheres.push_back(
            {place, random.logUniform(0.05, 0.4), static_cast<std::uint32_t>(1 + i % 2), i % 5 == 0});
        Light light;
        light.kind = static_cast<LightKind>(i % 2);
        light.position = random.inCube(6.0);
        light.direction = random.direction();
        light.angleDegrees = random.uniform(10.0, 170.0);
        light.fade = i % 4 == 1 ? SpotFade::Square : SpotFade::Smooth;
        light.power = glm::dvec3(random.uniform(1.0, 20.0));
        scene.lights.push_back(light);
    }
    scene.lights.push_back({{}, glm::dvec3(0.2), LightKind::Directional});
    scene.spheres.push_back({{0, 0.5, 1}, 1.5, 3, false});
    scene.spheres.push_back({{0, -1002, 0}, 1000.0, 0, false});
    TriangleMesh soup = testing::triangleSoup(random, 40, 5.0, 0.5);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
        soup.triangleMaterials.push_back(static_cast<std::uint32_t>(i % 3));
    scene.meshes.push_back(soup);
    scene.camera.position = {3, 5, 18};
    scene.camera.direction = -scene.camera.position;
    scene.camera.horizontalFovDegrees = 40.0;
    scene.camera.width = 48;
    scene.camera.height = 40;
    scene.settings.integrator = Integrator::Path;
    scene.settings.samplesPerPixel = 2;
    scene.settings.maxDepth = 6;
    return scene;
}

void expectOnePicture(const TestScene &scene, std::uint32_t steps, std::size_t turn) {
    const reference::Result wanted = renderOnCpu(scene);
    EXPECT_GE(wanted.rays.shadow, 1000u);
    for (gpu::RenderConfig config : testing::kernelsInTurn(turn)) {
        config.steps = steps;
        const gpu::Result device = renderOnDevice(scene, config);
        EXPECT_EQ(differingPixels(device.film, wanted.film), 0u) << gpu::kernelName(config);
        EXPECT_EQ(device.rays, wanted.rays);
    }
}

TEST(LightTreeTwins, AgreeOnEveryKindOfLight) { expectOnePicture(lampShop(1, false), 0, 2); }

TEST(LightTreeTwins, AgreeAroundRoughGlass) { expectOnePicture(lampShop(2, true), 0, 0); }

TEST(LightTreeTwins, AgreeWhenEveryFewStepsEndADispatch) { expectOnePicture(lampShop(3, true), 37, 1); }

TEST(LightTreeTwins, AgreeForManyLightsByWhitted) {
    TestScene scene = lampShop(4, false);
    scene.settings.integrator = Integrator::Whitted;
    expectOnePicture(scene, 0, 3);
}

} // namespace
} // namespace hyalite::core
