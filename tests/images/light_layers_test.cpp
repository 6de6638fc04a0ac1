// Layers of light: those of all classes add up to the picture, as those of all groups do; and each has what its name says.
#include "host/packing/light_planes.h"
#include "tests/fixtures/test_extent.h"
#include "tests/images/plain_scenes.h"
#include "tests/images/rendering.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <string>

namespace hyalite::core {
namespace {

using testing::addBall;
using testing::addQuad;
using testing::diffuse;

Material ofKind(MaterialKind kind, float roughness = 0.0f) {
    Material material;
    material.kind = kind;
    material.roughness = roughness;
    return material;
}

Light pointLight(const glm::dvec3 &position, const std::string &group) {
    Light light;
    light.position = position;
    light.power = glm::dvec3(200.0, 150.0, 100.0);
    light.lightGroup = group;
    return light;
}

/// A matt floor, a plastic ball, a mirror, a glass ball and a rough one, by two lights and a lamp.
TestScene manySurfaces() {
    TestScene scene = testing::emptyScene(6, 16);
    scene.background = {0.1f, 0.2f, 0.3f};
    addQuad(scene, {-3, -1.5f, 3}, {6, 0, 0}, {0, 0, -6}, diffuse({0.7f, 0.5f, 0.3f}));
    Material plastic = ofKind(MaterialKind::Principled, 0.3f);
    plastic.albedo = {0.2f, 0.5f, 0.8f};
    addBall(scene, {-0.9, -0.6, 0.0}, 0.6, plastic);
    addBall(scene, {0.3, -0.7, -0.6}, 0.5, ofKind(MaterialKind::Mirror));
    addBall(scene, {1.1, -0.6, 0.4}, 0.5, ofKind(MaterialKind::Dielectric));
    addBall(scene, {0.0, 0.7, 0.0}, 0.5, ofKind(MaterialKind::Dielectric, 0.3f));
    Material lamp = testing::lamp({4, 3, 2});
    lamp.lightGroup = "lamp";
    addBall(scene, {-0.7, 0.7, 0.3}, 0.2, lamp);
    scene.lights = {pointLight({2, 3, 4}, "key"), pointLight({-3, 2, 2}, "")};
    return scene;
}

/// A closed room of few triangles, whose paths are regenerated on the device, with all lobes of glTF on a ball.
TestScene room() {
    TestScene scene = testing::emptyScene(5, 16);
    const Material wall = diffuse(glm::vec3(0.7f));
    addQuad(scene, {-2, -2, 2}, {4, 0, 0}, {0, 0, -4}, wall);
    addQuad(scene, {-2, -2, -2}, {4, 0, 0}, {0, 4, 0}, diffuse({0.8f, 0.2f, 0.2f}));
    addQuad(scene, {-2, 2, -2}, {4, 0, 0}, {0, 0, 4}, wall);
    Material lamp = testing::lamp(glm::vec3(5.0f));
    lamp.lightGroup = "window";
    addQuad(scene, {-0.4f, 0.5f, -1.95f}, {0.8f, 0, 0}, {0, 0.5f, 0}, lamp);
    Material coated = ofKind(MaterialKind::Gltf, 0.4f);
    coated.metallic = 0.4f;
    coated.clearcoat = 0.5f;
    coated.sheenColour = glm::vec3(0.3f);
    coated.sheenRoughness = 0.5f;
    addBall(scene, {0.4, -0.8, 0.2}, 0.8, coated);
    return scene;
}

/// Thin glass, mirrors and metal before an environment.
TestScene outside() {
    TestScene scene = testing::emptyScene(6, 16);
    scene.environment = testing::studioEnvironment();
    scene.environment.lightGroup = "sky";
    Material pane = ofKind(MaterialKind::Gltf, 0.1f);
    pane.transmission = 0.8f;
    pane.isThin = true;
    addQuad(scene, {-1.4f, -1.4f, 1.0f}, {1.2f, 0, 0}, {0, 2, 0}, pane);
    addBall(scene, {0.5, 0.2, 0.0}, 0.8, ofKind(MaterialKind::Conductor, 0.2f));
    addBall(scene, {-0.4, -0.6, -0.5}, 0.6, diffuse({0.6f, 0.4f, 0.2f}));
    return scene;
}

TestScene withLayers(TestScene scene, bool byClass = true, bool byGroup = true) {
    scene.settings.hasLightLayers = byClass;
    scene.settings.hasLightGroups = byGroup;
    return scene;
}

bool isOfGroup(const std::string &plane) { return plane.starts_with("light_"); }

/// The mean of a layer over the picture.
glm::dvec3 meanOfLayer(const Film &film, const std::string &name) {
    const auto found = std::ranges::find(film.lightPlanes, name);
    if (found == film.lightPlanes.end())
        return glm::dvec3(-1.0);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < film.pixels.size(); ++i)
        sum += glm::dvec3(meanLightOf(film, i, static_cast<std::size_t>(found - film.lightPlanes.begin())));
    return sum / static_cast<double>(film.pixels.size());
}

struct LayersCase {
    std::string name;
    std::function<TestScene()> scene;
    std::size_t turn;
    std::vector<std::string> empty{}; ///< layers
};

class LightLayers : public ::testing::TestWithParam<LayersCase> {};

TEST_P(LightLayers, AddUpToThePicture) {
    const TestScene scene = GetParam().scene();
    const Film plain = testing::renderOnCpu(scene).film;
    const Film film = testing::renderOnCpu(withLayers(scene)).film;
    ASSERT_FALSE(film.lightPlanes.empty());
    EXPECT_TRUE(plain.light.empty());
    std::size_t shiningPixels = 0;
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const glm::vec3 wanted = meanOf(film.pixels[i]);
        ASSERT_EQ(wanted, meanOf(plain.pixels[i])) << "the layers change the picture";
        glm::vec3 ofClasses(0.0f);
        glm::vec3 ofGroups(0.0f);
        for (std::size_t plane = 0; plane < film.lightPlanes.size(); ++plane)
            (isOfGroup(film.lightPlanes[plane]) ? ofGroups : ofClasses) += meanLightOf(film, i, plane);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(ofClasses[channel], wanted[channel], 1e-6f * wanted[channel]) << "pixel " << i;
            EXPECT_NEAR(ofGroups[channel], wanted[channel], 1e-6f * wanted[channel]) << "pixel " << i;
        }
        shiningPixels += wanted.x > 0.0f ? 1u : 0u;
    }
    EXPECT_GT(shiningPixels, 50u);
    for (const std::string &name : film.lightPlanes) {
        const bool isEmpty = std::ranges::find(GetParam().empty, name) != GetParam().empty.end();
        EXPECT_EQ(meanOfLayer(film, name).x == 0.0, isEmpty) << name;
    }
}

TEST_P(LightLayers, HaveTheSameBitsOnTheDevice) {
    const TestScene scene = withLayers(GetParam().scene());
    const PackedScene packed = testing::pack(scene);
    const Film wanted = testing::renderOnCpu(scene, packed).film;
    for (const gpu::RenderConfig &config : testing::kernelsInTurn(GetParam().turn))
        EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene, packed, config).film, wanted), 0u)
            << gpu::kernelName(config);
    EXPECT_EQ(testing::differingPixels(testing::renderOnDevice(scene, packed, testing::cutShortKernel()).film,
                                       wanted),
              0u);
}

TEST_P(LightLayers, GoOnWithTheSameBits) {
    TestScene scene = withLayers(GetParam().scene());
    const PackedScene packed = testing::pack(scene);
    const Film wanted = testing::renderOnCpu(scene, packed).film;
    RenderSettings few = scene.settings;
    few.samplesPerPixel = 5;
    Film begun = reference::render(packed, few, Film(wanted.crop)).film;
    const gpu::Result rest = testing::rendererBy({}).render(packed, scene.settings, std::move(begun));
    EXPECT_EQ(testing::differingPixels(rest.film, wanted), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Each, LightLayers,
    ::testing::Values(LayersCase{"manySurfaces", manySurfaces, 0, {"transmission_direct"}},
                      LayersCase{"room", room, 1}, LayersCase{"outside", outside, 2}),
    [](const auto &each) { return each.param.name; });

/// A layer of both renderers is this, and all others are black.
void expectOnly(const TestScene &scene, const std::string &name, const glm::dvec3 &expected,
                double tolerance) {
    const TestScene layered = withLayers(scene, true, false);
    for (const Film &film : {testing::renderOnDevice(layered).film, testing::renderOnCpu(layered).film})
        for (const std::string &plane : film.lightPlanes) {
            const glm::dvec3 found = meanOfLayer(film, plane);
            const glm::dvec3 wanted = plane == name ? expected : glm::dvec3(0.0);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(found[channel], wanted[channel], plane == name ? tolerance : 0.0) << plane;
        }
}

/// A wall that fills the picture, by a sun of irradiance 2.
TestScene sunnyWall(const Material &material) {
    TestScene scene = testing::emptyScene(4, 64);
    addQuad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, material);
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = {0, 0, -1};
    sun.power = glm::dvec3(2.0);
    scene.lights = {sun};
    return scene;
}

TEST(LightLayer, OfAMattWallIsDiffuseAndDirect) {
    expectOnly(sunnyWall(diffuse({0.5f, 0.25f, 1.0f})), "diffuse_direct",
               glm::dvec3(0.5, 0.25, 1.0) * (2.0 / std::numbers::pi), 1e-6);
}

TEST(LightLayer, OfALampIsItsEmission) {
    TestScene scene = testing::emptyScene(4, 4);
    Material lamp = testing::lamp({3, 2, 1});
    lamp.albedo = glm::vec3(0.0f);
    addQuad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, lamp);
    expectOnly(scene, "emission", {3, 2, 1}, 1e-6);
}

TEST(LightLayer, OfABackgroundIsSeenAsItIs) {
    TestScene scene = testing::emptyScene(4, 4);
    scene.background = {0.25f, 0.5f, 0.75f};
    addBall(scene, {0, 0, 90}, 0.1, diffuse(glm::vec3(0.5f)));
    expectOnly(scene, "background", {0.25, 0.5, 0.75}, 1e-6);
}

// A mirror that shows the sky behind the camera, and one that shows a lit wall there.
TEST(LightLayer, OfAMirrorIsGlossyDirectOrIndirect) {
    TestScene scene = testing::emptyScene(4, 16);
    scene.background = {0.25f, 0.5f, 0.75f};
    addQuad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, ofKind(MaterialKind::Mirror));
    expectOnly(scene, "glossy_direct", {0.25, 0.5, 0.75}, 1e-6);
    TestScene walled = sunnyWall(ofKind(MaterialKind::Mirror));
    walled.settings.maxDepth = 3; // the wall sees the mirror
    addQuad(walled, {-90, -90, 9}, {0, 180, 0}, {180, 0, 0}, diffuse(glm::vec3(0.5f)));
    walled.lights[0].direction = {0, 0, 1};
    walled.lights[0].kind = LightKind::Point;
    walled.lights[0].position = {0, 0, 1};
    const Film film = testing::renderOnCpu(withLayers(walled)).film;
    EXPECT_GT(meanOfLayer(film, "glossy_indirect").x, 0.0);
    EXPECT_EQ(meanOfLayer(film, "glossy_direct"), glm::dvec3(0.0));
    EXPECT_EQ(meanOfLayer(film, "diffuse_direct"), glm::dvec3(0.0));
}

// Light through a pane is transmitted, and what the pane reflects is glossy: by Fresnel's equations, seen head on.
TEST(LightLayer, OfAPaneIsDividedByItsReflectance) {
    TestScene scene = testing::emptyScene(2, 1024);
    scene.camera.kind = CameraKind::Orthographic;
    scene.camera.viewWidth = 1.0;
    scene.background = glm::vec3(1.0f);
    addQuad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, ofKind(MaterialKind::Dielectric));
    const Film film = testing::renderOnCpu(withLayers(scene)).film;
    EXPECT_NEAR(meanOfLayer(film, "glossy_direct").x, 0.04, 0.002); // (0.5 / 2.5)^2
    EXPECT_NEAR(meanOfLayer(film, "transmission_direct").x, 0.96 / (1.5 * 1.5), 0.005);
    EXPECT_EQ(meanOfLayer(film, "background"), glm::dvec3(0.0));
}

// The base below plastic takes its colour; what its surface reflects does not.
TEST(LightLayer, OfPlasticIsDividedByItsLobes) {
    Material plastic = ofKind(MaterialKind::Principled, 0.5f);
    plastic.albedo = {0.8f, 0.4f, 0.0f};
    const Film film = testing::renderOnCpu(withLayers(sunnyWall(plastic))).film;
    const glm::dvec3 base = meanOfLayer(film, "diffuse_direct");
    const glm::dvec3 surface = meanOfLayer(film, "glossy_direct");
    EXPECT_GT(base.y, 0.05);
    EXPECT_NEAR(base.x, 2.0 * base.y, 1e-5);
    EXPECT_EQ(base.z, 0.0);
    EXPECT_GT(surface.x, 0.005);
    EXPECT_NEAR(surface.x, surface.z, 1e-5);
    EXPECT_NEAR(surface.y, surface.z, 1e-5);
}

// The layer of a group is the picture by its emitters alone.
TEST(LightGroup, HasTheLightOfItsEmitters) {
    TestScene scene = testing::emptyScene(4, 4096);
    addQuad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, diffuse(glm::vec3(0.5f)));
    scene.lights = {pointLight({2, 0, 3}, "key"), pointLight({-2, 0, 2}, "fill")};
    TestScene alone = scene;
    const Film film = testing::renderOnCpu(withLayers(scene, false, true)).film;
    EXPECT_EQ(film.lightPlanes, (std::vector<std::string>{"light_key", "light_fill"}));
    for (const std::string group : {"key", "fill"}) {
        alone.lights = {*std::ranges::find(scene.lights, group, &Light::lightGroup)};
        const Film wanted = testing::renderOnCpu(withLayers(alone, false, true)).film;
        const glm::dvec3 expected = meanOfLayer(wanted, "light_" + group);
        EXPECT_NEAR(meanOfLayer(film, "light_" + group).x, expected.x, 0.01 * expected.x);
    }
}

} // namespace
} // namespace hyalite::core
