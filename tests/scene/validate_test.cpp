// validateScene keeps what scene.h promises: each broken promise is refused with the object named.
#include "host/scene/validate.h"

#include "host/base/error.h"
#include "host/scene/limits.h"
#include "tests/fixtures/test_scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace hyalite::core {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TestScene validScene() {
    TestScene scene;
    scene.lights = {{glm::dvec3(-10.0, 20.0, 40.0), glm::dvec3(1e5)}};
    scene.materials.resize(1);
    scene.materials[0].name = "wall";
    scene.spheres.resize(2);
    TriangleMesh mesh;
    mesh.name = "triangle.obj";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals = {{0, 0, 1}};
    mesh.triangles = {{{0, 1, 2}, {0, 0, 0}}, {{2, 1, 0}}};
    scene.meshes = {mesh};
    return scene;
}

void validate(const TestScene &scene) {
    validateScene(scene, "source");
    validateSettings(scene.settings, scene, "source");
}

struct Breakage {
    const char *message; ///< all of it up to what is allowed, less the source's name
    std::function<void(TestScene &)> spoil;
};

void PrintTo(const Breakage &breakage, std::ostream *stream) { *stream << breakage.message; }

class Validate : public ::testing::TestWithParam<Breakage> {};

TEST_P(Validate, NamesTheObject) {
    TestScene scene = validScene();
    EXPECT_NO_THROW(validate(scene));
    GetParam().spoil(scene);
    try {
        validate(scene);
        FAIL() << "accepted";
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::BadInput);
        const std::string expected = std::string("source: ") + GetParam().message + "; allowed: ";
        EXPECT_TRUE(std::string(error.what()).starts_with(expected)) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(Table, Validate,
                         ::testing::
                             Values(Breakage{"scene: node: found index 1",
                                             [](TestScene &s) {
                                                 s.nodes.resize(1);
                                                 s.meshes[0].node = 1;
                                             }},
                                    Breakage{"node 1 (wheel): parent: found index 1",
                                             [](TestScene &s) {
                                                 s.nodes = {{.name = "car"}, {.name = "wheel", .parent = 1}};
                                             }},
                                    Breakage{"scene: meshes: found 1048577",
                                             [](TestScene &s) { s.meshes.resize(1048577); }},
                                    Breakage{"scene: materials: found 65537",
                                             [](TestScene &s) { s.materials.resize(65537); }},
                                    Breakage{"scene: background: found (0, nan, 0)",
                                             [](TestScene &s) { s.background.y = float(nan); }},
                                    Breakage{"scene: background: found (-1, 0, 0)",
                                             [](TestScene &s) { s.background.x = -1; }},
                                    Breakage{"scene: shadowThroughGlass: found 1.5",
                                             [](TestScene &s) { s.shadowThroughGlass = 1.5f; }},

                                    Breakage{"camera: position: found (0, 0, inf)",
                                             [](TestScene &s) { s.camera.position.z = infinity; }},
                                    Breakage{"camera: position: found (-2e+20, 0, 55)",
                                             [](TestScene &s) { s.camera.position.x = -2e20; }},
                                    Breakage{"camera: direction: found (nan, 0, -1)",
                                             [](TestScene &s) { s.camera.direction.x = nan; }},
                                    Breakage{"camera: length of direction: found 0",
                                             [](TestScene &s) { s.camera.direction = glm::dvec3(0); }},
                                    Breakage{"camera: length of up: found 0",
                                             [](TestScene &s) {
                                                 s.camera.up = {1e-300, 0, 0};
                                             }},
                                    Breakage{"camera: up: found the view direction's own axis",
                                             [](TestScene &s) {
                                                 s.camera.up = {0, 0, 1};
                                             }},
                                    Breakage{"camera: up: found the view direction's own axis",
                                             [](TestScene &s) {
                                                 s.camera.up = {0, 1e-8, -3};
                                             }},
                                    Breakage{"camera: horizontal field of view: found 0",
                                             [](TestScene &s) { s.camera.horizontalFovDegrees = 0; }},
                                    Breakage{"camera: horizontal field of view: found 180",
                                             [](TestScene &s) { s.camera.horizontalFovDegrees = 180; }},
                                    Breakage{"camera: horizontal field of view: found nan",
                                             [](TestScene &s) { s.camera.horizontalFovDegrees = nan; }},
                                    Breakage{
                                        "camera: width: found 0", [](TestScene &s) { s.camera.width = 0; }},
                                    Breakage{"camera: height: found 32769",
                                             [](TestScene &s) { s.camera.height = 32769; }},

                                    Breakage{
                                        "settings: spp: found 0",
                                        [](TestScene &s) { s.settings.samplesPerPixel = 0; }},
                                    Breakage{"settings: spp: found 65537",
                                             [](TestScene &s) { s.settings.samplesPerPixel = 65537; }},
                                    Breakage{"settings: maxDepth: found 33",
                                             [](TestScene &s) { s.settings.maxDepth = 33; }},
                                    Breakage{"settings: leafSize: found 65",
                                             [](TestScene &s) { s.settings.leafSize = 65; }},
                                    Breakage{
                                        "settings: exposure: found inf",
                                        [](TestScene &s) { s.settings.exposureStops = infinity; }},

                                    Breakage{"light 0: position: found (nan, 20, 40)",
                                             [](TestScene &s) { s.lights[0].position.x = nan; }},
                                    Breakage{"light 0: power: found (100000, -1, 100000)",
                                             [](TestScene &s) { s.lights[0].power.y = -1; }},

                                    Breakage{"material 0 (wall): albedo: found (0.5, 0.5, 1.5)",
                                             [](TestScene &s) { s.materials[0].albedo.z = 1.5f; }},
                                    Breakage{"material 0 (wall): index: found 0.5",
                                             [](TestScene &s) { s.materials[0].refractiveIndex = 0.5f; }},
                                    Breakage{"material 0 (wall): segmentTint: found (1, nan, 1)",
                                             [](TestScene &s) { s.materials[0].segmentTint.y = float(nan); }},
                                    Breakage{"material 0 (wall): emission: found (0, -1, 0)",
                                             [](TestScene &s) { s.materials[0].emission.y = -1.0f; }},
                                    Breakage{"material 0 (wall): absorption: found (nan, 0, 0)",
                                             [](TestScene &s) { s.materials[0].absorption.x = float(nan); }},
                                    Breakage{"material 0 (wall): roughness: found 1.5",
                                             [](TestScene &s) { s.materials[0].roughness = 1.5f; }},
                                    Breakage{"material 0 (wall): extinction: found (21, 21, 21)",
                                             [](TestScene &s) {
                                                 s.materials[0].conductorExtinction = glm::vec3(21.0f);
                                             }},
                                    Breakage{"material 0 (wall): clearcoat: found 1, and a transmission "
                                             "of 0.5",
                                             [](TestScene &s) {
                                                 s.materials[0].kind = MaterialKind::Principled;
                                                 s.materials[0].clearcoat = 1.0f;
                                                 s.materials[0].transmission = 0.5f;
                                             }},
                                    Breakage{"camera: aperture: found -1",
                                             [](TestScene &s) { s.camera.aperture = -1; }},
                                    Breakage{"camera: focusDistance: found 0",
                                             [](TestScene &s) { s.camera.focusDistance = 0; }},
                                    Breakage{"camera: viewWidth: found 0",
                                             [](TestScene &s) { s.camera.viewWidth = 0; }},
                                    Breakage{
                                        "settings: clamp: found -1",
                                        [](TestScene &s) { s.settings.radianceLimit = -1; }},
                                    Breakage{"light 0: length of direction: found 0",
                                             [](TestScene &s) { s.lights[0].direction = glm::dvec3(0); }},
                                    Breakage{
                                        "light 0: angle: found 181",
                                        [](TestScene &s) { s.lights[0].angleDegrees = 181; }},
                                    Breakage{"light 0: blend: found 2",
                                             [](TestScene &s) { s.lights[0].blend = 2; }},
                                    Breakage{"environment: radiance of pixel 1: found (-2, 0, 0)",
                                             [](TestScene &s) {
                                                 s.environment.radiance = Image(2, 1);
                                                 s.environment.radiance.at(1, 0).x = -1.0f;
                                                 s.environment.scale = 2.0f;
                                             }},
                                    Breakage{"scene: materials that light passes for the integrator "
                                             "path: found 9",
                                             [](TestScene &s) {
                                                 s.settings.integrator = Integrator::Path;
                                                 for (int i = 0; i < 9; ++i)
                                                     s.materials.emplace_back().kind =
                                                         MaterialKind::Dielectric;
                                             }},

                                    Breakage{"sphere 1: centre: found (inf, 0, 0)",
                                             [](TestScene &s) { s.spheres[1].centre.x = infinity; }},
                                    Breakage{"sphere 1: radius: found 0",
                                             [](TestScene &s) { s.spheres[1].radius = 0; }},
                                    Breakage{"sphere 1: radius: found -1",
                                             [](TestScene &s) { s.spheres[1].radius = -1; }},
                                    Breakage{"sphere 1: material: found index 1",
                                             [](TestScene &s) { s.spheres[1].materialIndex = 1; }},

                                    Breakage{"mesh 0 (triangle.obj): material: found index 7",
                                             [](TestScene &s) { s.meshes[0].materialIndex = 7; }},
                                    Breakage{"mesh 0 (triangle.obj): vertex 2: found (0, nan, 0)",
                                             [](TestScene &s) { s.meshes[0].positions[2].y = float(nan); }},
                                    Breakage{"mesh 0 (triangle.obj): vertex 0: found (2e+20, 0, 0)",
                                             [](TestScene &s) { s.meshes[0].positions[0].x = 2e20f; }},
                                    Breakage{"scene: extent of all meshes: found 9.99999983775159e-18",
                                             [](TestScene &s) {
                                                 for (glm::vec3 &position : s.meshes[0].positions)
                                                     position *= 1e-17f;
                                             }},
                                    Breakage{"mesh 0 (triangle.obj): length of normal 0: found 2",
                                             [](TestScene &s) { s.meshes[0].normals[0].z = 2; }},
                                    Breakage{"mesh 0 (triangle.obj): vertex of triangle 1: found index 3",
                                             [](TestScene &s) { s.meshes[0].triangles[1].positions.y = 3; }},
                                    Breakage{"mesh 0 (triangle.obj): normal of triangle 0: found index "
                                             "4294967295",
                                             [](TestScene &s) {
                                                 s.meshes[0].triangles[0].normals.y = MeshTriangle::noNormal;
                                             }}));

TEST(Validate, TheEndsOfTheRangesAreAllowed) {
    TestScene scene = validScene();
    scene.camera.width = 32768;
    scene.camera.height = 1;
    scene.camera.horizontalFovDegrees = 179.999;
    scene.camera.position = glm::dvec3(1e15, -1e15, 1e15);
    scene.camera.direction = {0.0, 0.0, 1e-99};
    scene.settings.samplesPerPixel = 65536;
    scene.settings.maxDepth = 32;
    scene.settings.leafSize = 64;
    scene.settings.seed = 4294967295u;
    scene.background = glm::vec3(1e30f); // as a float a little more than 1e30
    scene.lights.resize(1000);
    scene.spheres.resize(1000);
    scene.spheres[0].radius = 1e15;
    EXPECT_NO_THROW(validate(scene));
}

} // namespace
} // namespace hyalite::core
