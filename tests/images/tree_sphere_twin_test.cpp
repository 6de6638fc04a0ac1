// Scenes with more spheres than kernels test in turn have one picture, for every kernel and on both renderers.
#include "host/scene/instances.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

using testing::differingPixels;
using testing::renderOnCpu;
using testing::renderOnDevice;

/// Spheres of every kind of material, some of them lamps, some of them twice.
TestScene heap(std::uint64_t seed) {
    testing::Random random(seed);
    TestScene scene;
    scene.materials.resize(5);
    scene.materials[0].twoSided = true;
    scene.materials[1].kind = MaterialKind::Dielectric;
    scene.materials[1].refractiveIndex = 1.5f;
    scene.materials[2].kind = MaterialKind::Mirror;
    scene.materials[3].kind = MaterialKind::Conductor;
    scene.materials[3].roughness = 0.3f;
    scene.materials[4].emission = {6.0f, 5.0f, 4.0f};
    for (std::uint32_t i = 0; i < 120; ++i) {
        Sphere sphere{random.inCube(5.0), random.logUniform(0.1, 1.5), i % 4, i % 7 == 0};
        if (i % 40 == 0)
            sphere.materialIndex = 4;
        scene.spheres.push_back(sphere);
        if (i % 10 == 0)
            scene.spheres.push_back(sphere);
    }
    scene.camera.position = {4, 6, 22};
    scene.camera.direction = -scene.camera.position;
    scene.camera.horizontalFovDegrees = 40.0;
    scene.camera.width = 48;
    scene.camera.height = 40;
    scene.settings.samplesPerPixel = 2;
    scene.settings.maxDepth = 6;
    scene.background = {0.2f, 0.3f, 0.4f};
    scene.lights.push_back({{10, 20, 10}, glm::dvec3(8000.0)});
    return scene;
}

TestScene heapWithMeshes(std::uint64_t seed) {
    TestScene scene = heap(seed);
    testing::Random random(seed);
    scene.meshes.push_back(testing::placed(testing::gridCube(3), 1.5, {0, 5, 0}));
    std::vector<Placement> placements(12);
    for (Placement &placement : placements)
        placement.offset = glm::vec3(random.inCube(5.0));
    addInstances(scene, testing::icosphere(1), placements);
    return scene;
}

void expectOnePicture(TestScene scene, TreeKind tree, Integrator integrator, std::size_t turn) {
    scene.settings.tree = tree;
    scene.settings.integrator = integrator;
    const reference::Result wanted = renderOnCpu(scene);
    for (const gpu::RenderConfig &config : testing::kernelsInTurn(turn)) {
        const gpu::Result device = renderOnDevice(scene, config);
        EXPECT_EQ(differingPixels(device.film, wanted.film), 0u) << gpu::kernelName(config);
        EXPECT_EQ(device.rays, wanted.rays);
    }
}

TEST(TreeSphereTwins, AgreeForWhitted) {
    expectOnePicture(heap(1), TreeKind::Midpoint, Integrator::Whitted, 3);
}

TEST(TreeSphereTwins, AgreeForPaths) { expectOnePicture(heap(2), TreeKind::Sah, Integrator::Path, 1); }

TEST(TreeSphereTwins, AgreeAmongMeshesAndInstances) {
    expectOnePicture(heapWithMeshes(3), TreeKind::Sah, Integrator::Whitted, 2);
    expectOnePicture(heapWithMeshes(4), TreeKind::Midpoint, Integrator::Path, 0);
}

TEST(TreeSphereTwins, AgreeInViews) {
    expectOnePicture(heapWithMeshes(5), TreeKind::Sah, Integrator::Id, 3);
    expectOnePicture(heap(6), TreeKind::Sah, Integrator::Uv, 2);
    expectOnePicture(heap(7), TreeKind::Midpoint, Integrator::AmbientOcclusion, 1);
}

// The nearest hit is defined without the tree, so that it does not matter how spheres are found.
TEST(TreeSphereTwins, AgreeWithFewSpheresByTheOtherWay) {
    TestScene few = heap(8);
    few.spheres.resize(layout::maxUnrolledSpheres);
    TestScene many = few;
    for (int i = 0; i < 100; ++i) // behind the camera's back, and not seen by anything
        many.spheres.push_back({{0, 0, 1000.0 + 10 * i}, 0.1, 0, false});
    for (TestScene *const scene : {&few, &many}) {
        scene->materials[0].twoSided = false;
        scene->settings.integrator = Integrator::Normal;
    }
    EXPECT_EQ(differingPixels(renderOnCpu(few).film, renderOnCpu(many).film), 0u);
}

} // namespace
} // namespace hyalite::core
