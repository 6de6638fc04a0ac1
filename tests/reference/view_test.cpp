// The views against closed forms.
#include "host/reference/view.h"

#include "host/reference/renderer.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/test_scene.h"

namespace hyalite::core::reference {
namespace {

using hyalite::core::testing::addQuad;
using hyalite::core::testing::packed;

/// One pixel that looks from (0, 0, 5) along -z at a ball of radius 2.
TestScene ball(Integrator integrator) {
    TestScene scene;
    scene.camera.position = {0, 0, 5};
    scene.camera.width = 1;
    scene.camera.height = 1;
    scene.camera.horizontalFovDegrees = 1.0;
    scene.settings.integrator = integrator;
    scene.settings.sampler = SamplerKind::Centre;
    scene.settings.samplesPerPixel = 1;
    scene.materials.resize(2);
    scene.materials[0].albedo = {0.25f, 0.5f, 0.75f};
    scene.materials[1].kind = MaterialKind::Mirror;
    scene.spheres.push_back({{0, 0, 0}, 2.0, 0, false});
    return scene;
}

glm::vec3 pixelOf(const TestScene &scene) {
    return render(packed(scene), scene.settings, Crop{0, 1, 0, 1}).film.toImage().at(0, 0);
}

TEST(View, ShowsTheFirstHit) {
    EXPECT_EQ(pixelOf(ball(Integrator::Normal)), glm::vec3(0.5f, 0.5f, 1.0f));
    EXPECT_EQ(pixelOf(ball(Integrator::Depth)), glm::vec3(3.0f));
    EXPECT_EQ(pixelOf(ball(Integrator::Albedo)), glm::vec3(0.25f, 0.5f, 0.75f));
    TestScene mirror = ball(Integrator::Albedo);
    mirror.spheres[0].materialIndex = 1;
    EXPECT_EQ(pixelOf(mirror), glm::vec3(1.0f));
}

TEST(View, IsBlackWhereThereIsNothing) {
    for (const Integrator integrator :
         {Integrator::Normal, Integrator::Depth, Integrator::Albedo, Integrator::Id}) {
        TestScene scene = ball(integrator);
        scene.background = glm::vec3(1.0f);
        scene.spheres.clear();
        EXPECT_EQ(pixelOf(scene), glm::vec3(0.0f));
    }
}

TEST(View, PrimitivesHaveColoursOfTheirOwn) {
    TestScene scene = ball(Integrator::Id);
    const glm::vec3 first = pixelOf(scene);
    scene.spheres.push_back({{0, 0, 3}, 1.0, 0, false});
    const glm::vec3 second = pixelOf(scene);
    EXPECT_NE(first, second);
    for (int i = 0; i < 3; ++i) {
        EXPECT_GE(first[i], 0.2f);
        EXPECT_LT(second[i], 1.0f);
    }
}

/// The floor z = 0, seen from below the ceiling.
TestScene room(double occlusionDistance) {
    TestScene scene = ball(Integrator::AmbientOcclusion);
    scene.settings.samplesPerPixel = 4096;
    scene.settings.occlusionDistance = occlusionDistance;
    scene.spheres.clear();
    scene.meshes.emplace_back();
    addQuad(scene.meshes.back(), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    return scene;
}

TEST(AmbientOcclusion, OfAnOpenFloorIsOne) { EXPECT_EQ(pixelOf(room(1e15)), glm::vec3(1.0f)); }

TEST(AmbientOcclusion, UnderABallIsOneLessTheSquareOfItsSine) {
    TestScene scene = room(1e15);
    scene.camera.position = {0, 0, 0.5};
    scene.spheres.push_back({{0, 0, 2}, 1.2, 0, false});
    EXPECT_NEAR(pixelOf(scene).x, 1.0 - 0.36, 1e-3);
    EXPECT_EQ(pixelOf(scene).x, pixelOf(scene).z);
    // Nothing of it is nearer than 0.8, and all that is to be seen nearer than 1.6.
    scene.settings.occlusionDistance = 0.799;
    EXPECT_EQ(pixelOf(scene).x, 1.0f);
    scene.settings.occlusionDistance = 1.601;
    EXPECT_NEAR(pixelOf(scene).x, 1.0 - 0.36, 1e-3);
}

TEST(AmbientOcclusion, IsThatOfTheSideThatIsSeen) {
    TestScene scene = room(1e15);
    scene.spheres.push_back({{0, 0, -2}, 1.2, 0, false});
    EXPECT_EQ(pixelOf(scene), glm::vec3(1.0f));
    scene.camera.position = {0, 0, -0.5};
    scene.camera.direction = {0, 0, 1};
    EXPECT_NEAR(pixelOf(scene).x, 1.0 - 0.36, 1e-3);
}

} // namespace
} // namespace hyalite::core::reference
