// Cameras: what they see of glowing things near and far is what the plain path tracer sees.
#include "tests/fixtures/test_scene.h"
#include "tests/images/plain_comparison.h"
#include "tests/images/plain_scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace hyalite::core {
namespace {

struct View {
    std::string name;
    std::function<void(Camera &)> place;
};

void PrintTo(const View &view, std::ostream *stream) { *stream << view.name; }

class PlainCameras : public ::testing::TestWithParam<View> {};

INSTANTIATE_TEST_SUITE_P(All, PlainCameras,
                         ::testing::Values(View{"Pinhole", [](Camera &camera) { camera.height = 12; }},
                                           View{"TiltedPinhole",
                                                [](Camera &camera) {
                                                    camera.up = {0.5, 1.0, 0.25};
                                                    camera.direction = {0.1, -0.1, -1.0};
                                                    camera.horizontalFovDegrees = 70.0;
                                                }},
                                           View{"Lens",
                                                [](Camera &camera) {
                                                    camera.aperture = 0.6;
                                                    camera.focusDistance = 4.0;
                                                }},
                                           View{"LensFocusedFarAway",
                                                [](Camera &camera) {
                                                    camera.aperture = 0.8;
                                                    camera.focusDistance = 7.0;
                                                    camera.height = 10;
                                                    camera.horizontalFovDegrees = 50.0;
                                                }},
                                           View{"Orthographic",
                                                [](Camera &camera) {
                                                    camera.kind = CameraKind::Orthographic;
                                                    camera.viewWidth = 3.0;
                                                    camera.direction = {0.2, 0.1, -1.0};
                                                    camera.height = 14;
                                                }},
                                           View{"Panorama",
                                                [](Camera &camera) {
                                                    camera.kind = CameraKind::Panorama;
                                                    camera.position = {0.1, 0.2, 1.0};
                                                    camera.direction = {0.3, 0.0, -1.0};
                                                    camera.up = {0.1, 1.0, 0.0};
                                                    camera.width = 24;
                                                    camera.height = 12;
                                                }}),
                         [](const auto &instance) { return instance.param.name; });

TEST_P(PlainCameras, SeeTheSame) {
    TestScene scene = testing::emptyScene(1, 256);
    scene.environment = testing::studioEnvironment();
    GetParam().place(scene.camera);
    testing::addBall(scene, {-0.4, 0.3, 0.5}, 0.5, testing::lamp({2.0f, 0.1f, 0.3f}));
    testing::addBall(scene, {0.5, -0.3, -3.0}, 0.8, testing::lamp({0.1f, 2.0f, 0.5f}));
    testing::addBall(scene, {0.6, 0.6, 0.0}, 0.25, testing::lamp({0.2f, 0.3f, 3.0f}));
    testing::addQuad(scene, {-1.0f, -1.5f, -1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.2f, 0.5f},
                     testing::lamp({1.0f, 2.0f, 0.1f}));
    const int w = scene.camera.width;
    const int h = scene.camera.height;
    // Small regions tell where things are: a shift by a tenth of a pixel shows.
    testing::Comparison comparison{.regions = {}, .pathCount = 60'000, .errorLimit = 0.02};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            comparison.regions.push_back({x * w / 3, (x + 1) * w / 3, y * h / 3, (y + 1) * h / 3});
    testing::expectPlainRadiance(scene, comparison);
}

// Meridians of light, each edge inside of a pixel: how much of it is bright tells sine and arc tangent to a tenth of a
// degree.
TEST(PlainPanorama, HasItsMeridiansWhereTheyAre) {
    TestScene scene = testing::emptyScene(1, 16384);
    scene.camera.kind = CameraKind::Panorama;
    scene.camera.width = 36;
    scene.camera.height = 1;
    scene.environment.radiance = Image(720, 1);
    for (int x = 0; x < 720; ++x)
        scene.environment.radiance.at(x, 0) = glm::vec3((x + 7) / 20 % 2 == 0 ? 1.0f : 0.1f);
    testing::Comparison comparison{.regions = {}, .pathCount = 60'000};
    for (int x = 0; x < 18; x += 2)
        comparison.regions.push_back({x, x + 1, 0, 1});
    testing::expectPlainRadiance(scene, comparison);
}

// A far small ball becomes an evenly bright disc, of which each point shows a point of the lens.
TEST(PlainLens, IsEvenlyOpen) {
    TestScene scene = testing::emptyScene(1, 4096);
    scene.camera.width = 9;
    scene.camera.height = 9;
    scene.camera.aperture = 0.6;
    scene.camera.focusDistance = 2.0;
    scene.background = glm::vec3(0.1f);
    testing::addBall(scene, {0.0, 0.0, -4.0}, 0.4, testing::lamp({8.0f, 6.0f, 4.0f}));
    testing::expectPlainRadiance(
        scene, {.regions = {{4, 5, 4, 5}, {3, 4, 3, 4}, {6, 7, 4, 5}, {4, 5, 1, 2}}, .errorLimit = 0.06});
}

// Thin bars of light, which a filter that reaches into neighbouring pixels spreads.
TEST(PlainFilter, SpreadsTheSame) {
    for (const FilterKind filter : {FilterKind::Box, FilterKind::BlackmanHarris}) {
        TestScene scene = testing::emptyScene(1, 4096);
        scene.camera.width = 6;
        scene.camera.height = 6;
        scene.settings.filter = filter;
        scene.background = glm::vec3(0.5f);
        testing::addQuad(scene, {-0.15f, -2.0f, 0.0f}, {0.3f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f},
                         testing::lamp(glm::vec3(2.0f)));
        testing::addQuad(scene, {-2.0f, 0.3f, 0.1f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.0f},
                         testing::lamp({0.1f, 1.0f, 1.5f}));
        testing::expectPlainRadiance(
            scene, {.regions = {{1, 2, 2, 3}, {2, 3, 4, 5}, {3, 4, 2, 3}, {4, 5, 1, 2}, {4, 5, 4, 5}},
                    .errorLimit = 0.02});
    }
}

} // namespace
} // namespace hyalite::core
