// Textures: the renderers' mean radiance is that of the plain path tracer, for each use of an image.
#include "tests/images/plain_comparison.h"
#include "tests/images/plain_scenes.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace hyalite::core {
namespace {

using testing::Comparison;
using testing::levelTexture;

struct Wearing {
    std::string name;
    std::function<void(TestScene &, Material &)> put;
};

void PrintTo(const Wearing &wearing, std::ostream *stream) { *stream << wearing.name; }

const Texture colours = levelTexture(3, 2,
                                     {{255, 40, 40, 255},
                                      {40, 255, 40, 255},
                                      {40, 40, 255, 255},
                                      {250, 240, 60, 255},
                                      {60, 60, 60, 255},
                                      {230, 100, 200, 255}});
const Texture greys =
    levelTexture(2, 2, {{255, 0, 0, 255}, {120, 0, 0, 255}, {80, 0, 0, 255}, {200, 0, 0, 255}});
// Tilted to the right, up, to the left and down, and more and less so.
const Texture slopes = levelTexture(
    2, 2, {{190, 128, 230, 255}, {128, 200, 220, 255}, {90, 128, 240, 255}, {128, 80, 230, 255}});
const Texture holes = levelTexture(
    3, 2, {{9, 9, 9, 255}, {9, 9, 9, 0}, {9, 9, 9, 200}, {9, 9, 9, 60}, {9, 9, 9, 250}, {9, 9, 9, 30}});

Texture floatTexture() {
    Texture texture{"floats of the test", 2, 1};
    texture.values = {{2.0f, 0.5f, 0.25f}, {0.25f, 1.0f, 3.0f}};
    return texture;
}

void makePlastic(Material &material) {
    material.kind = MaterialKind::Principled;
    material.roughness = 0.6f;
}

std::vector<Wearing> wearings() {
    std::vector<Wearing> all;
    all.push_back({"BaseColour", [](TestScene &scene, Material &material) {
                       testing::wear(scene, material, layout::slotBaseColour, colours);
                   }});
    all.push_back(
        {"PlacedBaseColour", [](TestScene &scene, Material &material) {
             makePlastic(material);
             testing::wear(scene, material, layout::slotBaseColour, colours, {2.0f, -1.5f}, {0.3f, 0.1f});
         }});
    all.push_back({"Emission", [](TestScene &scene, Material &material) {
                       material.emission = {2.0f, 1.5f, 1.0f};
                       testing::wear(scene, material, layout::slotEmission, colours);
                   }});
    all.push_back(
        {"EmissionOfFloats", [](TestScene &scene, Material &material) {
             material.emission = {1.0f, 1.0f, 1.0f};
             testing::wear(scene, material, layout::slotEmission, floatTexture(), {1.0f, 1.0f}, {0.2f, 0.0f});
         }});
    all.push_back({"Roughness", [](TestScene &scene, Material &material) {
                       makePlastic(material);
                       material.roughness = 1.0f;
                       material.metallic = 1.0f;
                       testing::wear(scene, material, layout::slotRoughness, greys);
                   }});
    all.push_back({"Metallic", [](TestScene &scene, Material &material) {
                       makePlastic(material);
                       material.metallic = 0.9f;
                       testing::wear(scene, material, layout::slotMetallic, greys);
                   }});
    all.push_back({"Normal", [](TestScene &scene, Material &material) {
                       testing::wear(scene, material, layout::slotNormal, slopes);
                   }});
    all.push_back({"StrongNormalOfPlastic", [](TestScene &scene, Material &material) {
                       makePlastic(material);
                       material.normalStrength = 1.7f;
                       testing::wear(scene, material, layout::slotNormal, slopes, {1.0f, -1.0f});
                   }});
    return all;
}

class PlainTextures : public ::testing::TestWithParam<Wearing> {};

INSTANTIATE_TEST_SUITE_P(All, PlainTextures, ::testing::ValuesIn(wearings()),
                         [](const auto &instance) { return instance.param.name; });

TestScene room() {
    TestScene scene = testing::emptyScene(2);
    scene.environment = testing::studioEnvironment();
    return scene;
}

Material grey() { return testing::diffuse({0.8f, 0.7f, 0.6f}); }

TEST_P(PlainTextures, LookTheSameOnATile) {
    TestScene scene = room();
    Material material = grey();
    GetParam().put(scene, material);
    testing::addQuad(scene, {-1.0f, -1.0f, 0.3f}, {2.0f, 0.0f, 0.0f}, {0.2f, 2.0f, -0.6f}, material);
    Comparison comparison{.regions = {{1, 8, 1, 8}, {8, 15, 1, 8}, {1, 8, 8, 15}, {8, 15, 8, 15}},
                          .pathCount = 80'000};
    comparison.allowance = testing::energyAllowance;
    testing::expectPlainRadiance(scene, comparison);
}

TEST_P(PlainTextures, LookTheSameOnABall) {
    TestScene scene = room();
    Material material = grey();
    GetParam().put(scene, material);
    testing::addBall(scene, {0.0, 0.0, 0.0}, 1.0, material);
    Comparison comparison{.regions = {{1, 8, 1, 8}, {8, 15, 1, 8}, {1, 8, 8, 15}, {8, 15, 8, 15}},
                          .pathCount = 80'000};
    comparison.allowance = testing::energyAllowance;
    testing::expectPlainRadiance(scene, comparison);
}

// Where u grows to the left green still points along v.
TEST(PlainTextures, BendTheSameWhereTheyAreMirrored) {
    TestScene scene = room();
    Material material = grey();
    testing::wear(scene, material, layout::slotNormal, slopes);
    testing::addQuad(scene, {-1.0f, -1.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f}, material).uvs = {
        {1.0f, 0.0f}, {0.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 1.0f}};
    testing::expectPlainRadiance(scene,
                                 {.regions = {{1, 8, 1, 8}, {8, 15, 1, 8}, {1, 8, 8, 15}, {8, 15, 8, 15}}});
}

// Steep maps that are seen at grazing angles: normals that face away from the eye, and ones that mirror into the
// surface.
TEST(PlainTextures, BendTheSameAtGrazingAngles) {
    TestScene scene = room();
    Material material = grey();
    makePlastic(material);
    material.roughness = 0.3f;
    material.normalStrength = 3.0f;
    testing::wear(scene, material, layout::slotNormal, slopes);
    testing::addQuad(scene, {-1.0f, -0.4f, 1.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.5f, -3.0f}, material);
    Comparison comparison{.regions = {{3, 8, 7, 9}, {8, 13, 7, 9}, {2, 14, 9, 11}}};
    comparison.allowance = testing::energyAllowance;
    testing::expectPlainRadiance(scene, comparison);
}

// Their light on a wall: the tile and the ball are emitters that are aimed at, and are not seen.
TEST(PlainTextures, ShineTheSame) {
    for (const bool isCutOut : {false, true}) {
        TestScene scene = testing::emptyScene(2);
        testing::addQuad(scene, {-2.0f, -2.0f, 0.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}, grey());
        Material glowing = testing::lamp({3.0f, 2.0f, 1.0f});
        testing::wear(scene, glowing, layout::slotEmission, colours);
        testing::addBall(scene, {-1.0, 1.4, 0.8}, 0.4, glowing);
        if (isCutOut)
            testing::wear(scene, glowing, layout::slotOpacity, holes);
        testing::addQuad(scene, {1.2f, -1.0f, 1.2f}, {0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, -1.0f}, glowing);
        testing::expectPlainRadiance(scene, {.regions = {{0, 8, 0, 8}, {8, 16, 0, 8}, {8, 16, 8, 16}},
                                             .pathCount = 80'000,
                                             .errorLimit = 0.022,
                                             .search = testing::Search::ByAiming});
    }
}

// Decoded and as levels.
TEST(PlainTextures, CutTheSameHoles) {
    TestScene scene = room();
    scene.lights.push_back({{-1.0, 1.0, 3.0}, {30.0, 40.0, 50.0}});
    Material leaf = grey();
    leaf.twoSided = true;
    testing::wear(scene, leaf, layout::slotOpacity, holes);
    testing::wear(scene, leaf, layout::slotBaseColour, colours);
    testing::addQuad(scene, {-0.7f, -0.7f, 0.8f}, {1.2f, 0.0f, 0.0f}, {0.0f, 1.2f, 0.2f}, leaf);
    testing::addQuad(scene, {-2.0f, -2.0f, 0.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}, grey());
    const Comparison comparison{.regions = {{2, 8, 2, 8}, {8, 14, 2, 8}, {2, 8, 8, 14}, {8, 14, 8, 14}},
                                .pathCount = 100'000};
    testing::expectPlainRadiance("device", testing::renderOnDevice(scene).film, scene, comparison);
    testing::expectPlainRadiance("device, of levels", testing::renderOnDevice(scene, {}, 0).film, scene,
                                 comparison);
    testing::expectPlainRadiance("cpu", testing::renderOnCpu(scene).film, scene, comparison);
}

// By chance, before a wall that they shade.
TEST(PlainTextures, BlendTheSame) {
    TestScene scene = room();
    scene.lights.push_back({{-1.0, 1.0, 3.0}, {30.0, 40.0, 50.0}});
    Material leaf = grey();
    leaf.twoSided = true;
    leaf.alphaMode = AlphaMode::Blend;
    leaf.opacity = 0.8f;
    testing::wear(scene, leaf, layout::slotOpacity, holes);
    testing::addQuad(scene, {-0.7f, -0.7f, 0.8f}, {1.2f, 0.0f, 0.0f}, {0.0f, 1.2f, 0.2f}, leaf);
    Material glowing = testing::lamp({1.0f, 2.0f, 3.0f});
    glowing.alphaMode = AlphaMode::Blend;
    glowing.opacity = 0.5f;
    testing::addQuad(scene, {-1.5f, 0.8f, 0.5f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, glowing);
    testing::addQuad(scene, {-2.0f, -2.0f, 0.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}, grey());
    testing::expectPlainRadiance(
        scene,
        {.regions = {{2, 8, 2, 8}, {8, 14, 2, 8}, {2, 8, 8, 14}, {8, 14, 8, 14}}, .pathCount = 100'000});
}

} // namespace
} // namespace hyalite::core
