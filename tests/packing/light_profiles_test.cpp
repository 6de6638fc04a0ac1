// Profiles of lights as lookup rows: once for all lights that have them, and their light's power and directions.
#include "host/packing/light_profiles.h"

#include "host/bvh/bvh.h"
#include "tests/fixtures/geometry_fixture.h"
#include "tests/fixtures/profile_of_lamp.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyalite::core {
namespace {

using testing::crookedLamp;
using testing::packed;
using testing::ringLamp;
using testing::uplight;

Scene lampScene() {
    Scene scene;
    scene.materials.resize(1);
    scene.spheres.push_back({{0, 0, 0}, 1.0, 0, false});
    scene.profiles = {crookedLamp(), ringLamp()};
    scene.lights = {{{0, 3, 0}, glm::dvec3(4.0)},
                    {{1, 3, 0}, glm::dvec3(5.0)},
                    {{2, 3, 0}, glm::dvec3(6.0), LightKind::Spot},
                    {{3, 3, 0}, glm::dvec3(7.0)}};
    scene.lights[1].profile = 0;
    scene.lights[2].profile = 1;
    scene.lights[3].profile = 0;
    scene.lights[3].c0 = {3, 1, 4};
    return scene;
}

TEST(LightProfiles, WithoutAnyThereAreNoRows) {
    Scene scene = lampScene();
    for (Light &light : scene.lights)
        light.profile.reset();
    const PackedScene result = packed(scene);
    EXPECT_EQ(result.frame.lightProfiles, 0u);
    EXPECT_EQ(result.lookups.size(), std::size_t{layout::filterCellCount});
    EXPECT_EQ(result.lighting, layout::lightsByPoints | layout::lightsBySpots);
    scene.profiles.clear();
    EXPECT_EQ(packed(scene).contentHash(), result.contentHash());
}

TEST(LightProfiles, TablesStandOnce) {
    const PackedScene result = packed(lampScene());
    const std::uint32_t first = result.frame.lightProfiles;
    EXPECT_EQ(result.lighting, layout::lightsByPoints | layout::lightsByProfiles);
    EXPECT_EQ(result.lookups[first].word, 3u);
    EXPECT_EQ(result.lookups[first + 2].word, 3u);
    const std::size_t ofCrooked = 1 + 9 + 7 + 9 * 7;
    EXPECT_EQ(result.lookups[first + 1].word, 3u + ofCrooked);
    const std::size_t ofRing = 1 + 4 + 1 + 4; // with what is dark before and behind it
    EXPECT_EQ(result.lookups.size(), first + 3 + ofCrooked + ofRing);
    EXPECT_EQ(result.lookups[first].value, glm::vec3(1, 0, 0));
    const glm::vec3 turned = result.lookups[first + 2].value;
    EXPECT_NEAR(glm::length(turned), 1.0f, 1e-6f);
    EXPECT_NEAR(turned.y, 0.0f, 1e-7f);
    EXPECT_NEAR(turned.x / turned.z, 0.75f, 1e-6f);
    for (std::uint32_t i = 1; i < 4; ++i) {
        EXPECT_EQ(lightKindOf(result.lights[i]), layout::lightProfiled);
        EXPECT_EQ(profileOf(result.lights[i]), i - 1);
        EXPECT_EQ(result.emitters[i].kind, layout::emitterProfiled);
        EXPECT_EQ(result.emitters[i].record, i - 1);
        EXPECT_EQ(result.emitters[i].axis, glm::vec3(0, -1, 0));
    }
    EXPECT_LT(result.lights[1].cosineOuter, -1.0f) << "a point has no cone";
    EXPECT_NEAR(result.lights[2].cosineOuter, std::cos(std::numbers::pi / 6.0), 1e-6);
}

TEST(LightProfiles, HashesTellProfilesApart) {
    const Scene scene = lampScene();
    const std::uint64_t hash = packed(scene).contentHash();
    const auto expectOther = [&](const auto &change) {
        Scene other = scene;
        change(other);
        EXPECT_NE(packed(other).contentHash(), hash);
    };
    expectOther([](Scene &other) { other.profiles[0].shares[7] *= 0.5f; });
    expectOther([](Scene &other) { other.profiles[1].gammas[1] += 1.0; });
    expectOther([](Scene &other) { other.lights[1].c0 = {0, 0, 1}; });
    expectOther([](Scene &other) { other.lights[1].profile = 1; });
    Scene renamed = scene;
    renamed.profiles[0].name = "other.ies";
    std::swap(renamed.profiles[0], renamed.profiles[1]);
    for (Light &light : renamed.lights)
        if (light.profile)
            light.profile = 1 - *light.profile;
    EXPECT_EQ(packed(renamed).contentHash(), hash);
}

TEST(LightProfiles, LightsAreReplacedAsIfAllWerePackedAnew) {
    Scene scene = lampScene();
    const Bvh bvh = buildBvh(TreeKind::Sah, buildTriangles(scene), 1);
    PackedScene result = packScene(scene, bvh);
    const auto expectSame = [&] {
        packLights(scene, LightChoice::Auto, result);
        const PackedScene expected = packScene(scene, bvh);
        for (std::size_t i = 0; i < expected.arrays().size(); ++i)
            EXPECT_TRUE(std::ranges::equal(result.arrays()[i].bytes, expected.arrays()[i].bytes))
                << expected.arrays()[i].name;
        EXPECT_EQ(result.frame.lightProfiles, expected.frame.lightProfiles);
        EXPECT_EQ(result.lighting, expected.lighting);
    };
    scene.lights.erase(scene.lights.begin() + 1);
    expectSame();
    const std::vector<Light> lights = scene.lights;
    scene.lights.resize(1);
    expectSame();
    scene.lights = lights;
    expectSame();
}

TEST(LightProfiles, PowerIsThatWithinTheCone) {
    Scene scene = lampScene();
    scene.lights.erase(scene.lights.begin() + 3);
    scene.lights[1].profile = 1;
    PackedScene result = packed(scene);
    ASSERT_EQ(result.emitters.size(), 3u);
    const double ofPoint = 5.0 * meanShare(scene.profiles[1]);
    const double ofSpot = 6.0 * meanShare(scene.profiles[1], 30.0);
    EXPECT_GT(ofSpot, 0.0);
    EXPECT_NEAR(result.emitters[1].probability, ofPoint / (4.0 + ofPoint + ofSpot), 1e-6);
    EXPECT_NEAR(result.emitters[2].probability, ofSpot / (4.0 + ofPoint + ofSpot), 1e-6);
    scene.lights[2].angleDegrees = 20.0; // the ring's hole
    EXPECT_EQ(packed(scene).emitters.size(), 2u) << "no ray aims at what is dark";
}

TEST(LightProfiles, ConesHoldAllTheirLight) {
    Scene scene = lampScene();
    scene.profiles = {crookedLamp(), ringLamp(), uplight()};
    Light light = scene.lights[1];
    light.direction = {1, 0, 0};
    const auto coneOf = [&](std::uint32_t profile) {
        light.profile = profile;
        return profiledLight(scene, light);
    };
    EXPECT_EQ(coneOf(0).cosine, -1.0f);
    EXPECT_EQ(coneOf(1).axis, glm::vec3(1, 0, 0));
    EXPECT_NEAR(coneOf(1).cosine, std::cos(70.0 / 180.0 * std::numbers::pi), 1e-6);
    EXPECT_EQ(coneOf(2).axis, glm::vec3(-1, 0, 0));
    EXPECT_NEAR(coneOf(2).cosine, 0.0, 1e-6);
    light.kind = LightKind::Spot;
    light.angleDegrees = 40.0;
    EXPECT_NEAR(coneOf(1).cosine, std::cos(40.0 / 180.0 * std::numbers::pi), 1e-6);
    EXPECT_EQ(coneOf(2).meanShare, 0.0);
}

} // namespace
} // namespace hyalite::core
