// Lights: on matt and on metal surfaces, the renderers' mean radiance is that of the plain path tracer.
#include "tests/fixtures/profile_of_lamp.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/plain_comparison.h"
#include "tests/images/plain_scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <tuple>

namespace hyalite::core {
namespace {

using testing::Comparison;
using testing::expectPlainRadiance;
using testing::lamp;
using testing::Search;

struct Lighting {
    std::string name;
    std::function<void(TestScene &)> install;
    Search search = Search::ByAiming;
};

void PrintTo(const Lighting &lighting, std::ostream *stream) { *stream << lighting.name; }

Light light(LightKind kind, const glm::dvec3 &position, const glm::dvec3 &power,
            const glm::dvec3 &direction) {
    Light made{position, power, kind, direction};
    made.angleDegrees = 35.0;
    made.blend = 0.6;
    return made;
}

/// Above the floor to the left, facing down to the right.
void addPanel(TestScene &scene, const Material &material) {
    testing::addQuad(scene, {-2.0f, 0.5f, 1.0f}, {0.0f, 0.0f, -2.0f}, {1.0f, 1.0f, 0.0f}, material);
}

std::vector<Lighting> lightings() {
    const Light spot = light(LightKind::Spot, {1.0, 2.0, 1.5}, {90.0, 80.0, 60.0}, {-0.4, -1.0, -0.5});
    std::vector<Lighting> all;
    all.push_back({"Point", [](TestScene &scene) {
                       scene.lights.push_back({{-1.0, 2.0, 2.0}, {50.0, 60.0, 70.0}});
                   }});
    all.push_back({"Spot", [spot](TestScene &scene) { scene.lights.push_back(spot); }});
    all.push_back({"SquareSpot", [spot](TestScene &scene) {
                       scene.lights.push_back(spot);
                       scene.lights.back().fade = SpotFade::Square;
                   }});
    all.push_back({"SharpSpot", [spot](TestScene &scene) {
                       scene.lights.push_back(spot);
                       scene.lights.back().blend = 0.0;
                   }});
    all.push_back({"ProfiledPoint", [](TestScene &scene) {
                       scene.profiles = {testing::crookedLamp()};
                       scene.lights.push_back(
                           light(LightKind::Point, {-1.0, 2.0, 2.0}, {90.0, 60.0, 70.0}, {0.3, -1.0, -0.6}));
                       scene.lights.back().profile = 0;
                       scene.lights.back().c0 = {0.2, 0.1, 1.0};
                   }});
    all.push_back({"ProfiledSpot", [spot](TestScene &scene) {
                       scene.profiles = {testing::ringLamp(), testing::crookedLamp()};
                       scene.lights.push_back(spot);
                       scene.lights.back().profile = 1;
                   }});
    const auto profiled = [](TestScene &scene) {
        scene.profiles = {testing::crookedLamp(), testing::ringLamp(), testing::uplight()};
        for (std::uint32_t i = 0; i < 6; ++i) {
            const glm::dvec3 place{0.5 * (i % 3) - 1.0, i % 3 == 2 ? 0.8 : 1.6, 0.7 * (i / 3)};
            scene.lights.push_back(light(i % 2 == 0 ? LightKind::Point : LightKind::Spot, place,
                                         {9.0, 8.0, 7.0}, {0.2 * (i % 4) - 0.3, -1.0, 0.1}));
            scene.lights.back().angleDegrees = 120.0;
            scene.lights.back().profile = i % 3;
        }
        scene.lights.push_back({{-1.0, 2.0, 2.0}, {5.0, 6.0, 7.0}});
    };
    all.push_back({"ManyProfiled", profiled});
    all.push_back({"ManyProfiledByTree", [profiled](TestScene &scene) {
                       profiled(scene);
                       scene.settings.lightChoice = LightChoice::Tree;
                   }});
    all.push_back(
        {"Directional", [](TestScene &scene) {
             scene.lights.push_back(light(LightKind::Directional, {}, {1.5, 1.0, 2.0}, {1.0, -1.0, -1.0}));
         }});
    all.push_back({"Panel", [](TestScene &scene) { addPanel(scene, lamp({6.0f, 5.0f, 4.0f})); }});
    all.push_back(
        {"PanelSeenFromBehind", [](TestScene &scene) {
             Material paper = lamp({6.0f, 5.0f, 4.0f});
             paper.twoSided = true;
             testing::addQuad(scene, {-2.0f, 0.5f, 1.0f}, {1.0f, 1.0f, 0.0f}, {0.0f, 0.0f, -2.0f}, paper);
         }});
    all.push_back({"PanelThatFacesAway", [](TestScene &scene) {
                       scene.background = {0.3f, 0.4f, 0.5f};
                       testing::addQuad(scene, {-2.0f, 0.5f, 1.0f}, {1.0f, 1.0f, 0.0f}, {0.0f, 0.0f, -2.0f},
                                        lamp({9.0f, 9.0f, 9.0f}));
                   }});
    all.push_back({"Bulb", [](TestScene &scene) {
                       testing::addBall(scene, {-1.2, 1.0, 0.5}, 0.5, lamp({8.0f, 6.0f, 4.0f}));
                   }});
    all.push_back({"BulbOnTheFloor",
                   [](TestScene &scene) {
                       testing::addBall(scene, {-1.0, -0.5, 0.4}, 0.5, lamp({3.0f, 4.0f, 5.0f}));
                   },
                   Search::ByScattering});
    all.push_back({"GlowingDome",
                   [](TestScene &scene) {
                       testing::addBall(scene, {0.0, 0.0, 0.0}, 8.0, lamp({0.4f, 0.5f, 0.6f}), true);
                   },
                   Search::ByScattering});
    all.push_back({"Background", [](TestScene &scene) { scene.background = {0.3f, 0.5f, 0.7f}; }});
    all.push_back(
        {"Environment", [](TestScene &scene) { scene.environment = testing::studioEnvironment(); }});
    all.push_back({"TurnedEnvironment", [](TestScene &scene) {
                       scene.environment = testing::studioEnvironment(75.0);
                       scene.environment.scale = 1.5f;
                   }});
    all.push_back(
        {"AllOfThem", [spot](TestScene &scene) {
             scene.environment = testing::studioEnvironment(-30.0);
             scene.lights.push_back({{-1.0, 2.0, 2.0}, {5.0, 6.0, 7.0}});
             scene.lights.push_back(spot);
             scene.lights.push_back(light(LightKind::Directional, {}, {0.5, 0.4, 0.3}, {1.0, -1.0, -1.0}));
             addPanel(scene, lamp({2.0f, 1.0f, 1.0f}));
             testing::addBall(scene, {1.0, 0.5, -0.5}, 0.2, lamp({4.0f, 6.0f, 4.0f}));
         }});
    all.push_back({"AllOfThemByTree", [everything = all.back().install](TestScene &scene) {
                       everything(scene);
                       scene.settings.lightChoice = LightChoice::Tree;
                   }});
    all.push_back({"ManyByTree", [](TestScene &scene) {
                       for (int i = 0; i < 12; ++i) {
                           const double x = 0.4 * (i - 6);
                           const float glow = 2.0f + static_cast<float>(i % 3);
                           testing::addBall(scene, {x, 0.8, 0.1 * (i % 5)}, 0.12, lamp({glow, 3.0f, 4.0f}));
                           scene.lights.push_back({{x, 1.5, -1.0}, glm::dvec3(i % 4)});
                       }
                       addPanel(scene, lamp({2.0f, 1.0f, 1.0f}));
                       scene.settings.lightChoice = LightChoice::Tree;
                   }});
    return all;
}

class PlainLights : public ::testing::TestWithParam<std::tuple<Lighting, bool>> {};

INSTANTIATE_TEST_SUITE_P(All, PlainLights,
                         ::testing::Combine(::testing::ValuesIn(lightings()), ::testing::Bool()),
                         [](const auto &instance) {
                             return std::get<0>(instance.param).name +
                                    (std::get<1>(instance.param) ? "OnMetal" : "OnMatt");
                         });

// A floor and a ball. Matt ones alone and those among others are shaded by different code.
TEST_P(PlainLights, FallTheSameOnAFloorAndABall) {
    const auto &[lighting, isMetal] = GetParam();
    TestScene scene = testing::emptyScene(3);
    scene.camera.position = {0.0, 0.5, 4.0};
    scene.camera.direction = {0.0, -0.25, -1.0};
    Material ballMaterial = testing::diffuse({0.7f, 0.6f, 0.5f});
    if (isMetal) {
        ballMaterial.kind = MaterialKind::Conductor;
        ballMaterial.roughness = 0.5f;
    }
    testing::addQuad(scene, {-3.0f, -1.0f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f},
                     testing::diffuse({0.5f, 0.6f, 0.7f}));
    testing::addBall(scene, {0.3, -0.4, 0.0}, 0.6, ballMaterial);
    lighting.install(scene);
    Comparison comparison{.regions = {{0, 16, 4, 16}, {6, 12, 6, 11}, {1, 7, 8, 15}}};
    comparison.errorLimit = 0.018;
    comparison.allowance = isMetal ? testing::energyAllowance : comparison.allowance;
    comparison.search = lighting.search;
    expectPlainRadiance(scene, comparison);
}

// A lamp in a ball of rough glass, which shadow rays from outside do not reach, and those from its surface do.
TEST(PlainLights, PassRoughGlassFromInside) {
    for (const bool isPoint : {true, false}) {
        TestScene scene = testing::emptyScene(4);
        Material glass;
        glass.kind = MaterialKind::Dielectric;
        glass.roughness = 0.5f;
        glass.absorption = {0.2f, 0.4f, 0.8f};
        testing::addBall(scene, {0.0, 0.0, 0.0}, 1.0, glass);
        scene.background = {0.1f, 0.1f, 0.1f};
        if (isPoint)
            scene.lights.push_back({{0.3, 0.2, 0.1}, {10.0, 10.0, 10.0}});
        else
            testing::addBall(scene, {0.3, 0.2, 0.1}, 0.4, lamp({1.0f, 1.0f, 1.0f}));
        expectPlainRadiance(
            scene, {.regions = {{4, 12, 4, 12}, {0, 16, 0, 16}}, .errorLimit = 0.02, .allowance = 1e-3});
    }
}

} // namespace
} // namespace hyalite::core
