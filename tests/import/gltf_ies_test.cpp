// EXT_lights_ies: profiles of lamps in glTF files, by file and by view.
#include "host/import/load.h"
#include "tests/fixtures/gltf_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

namespace hyalite::core {
namespace {

const std::string lampText =
    "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 50\n0 45 90\n0\n80 200 10\n";

class GltfIes : public GltfFolder {
  protected:
    void SetUp() override { std::ofstream(folder / "lamp.ies") << lampText; }

    /// A triangle, and a node for each use of a light.
    [[nodiscard]] static GltfMaker made(const nlohmann::json &lights,
                                        const std::vector<nlohmann::json> &uses) {
        GltfMaker maker = oneTriangle();
        maker.json["extensionsUsed"] = {"EXT_lights_ies"};
        maker.json["extensionsRequired"] = {"EXT_lights_ies"};
        maker.json["extensions"]["EXT_lights_ies"]["lights"] = lights;
        for (const nlohmann::json &use : uses) {
            maker.json["scenes"][0]["nodes"].push_back(maker.json["nodes"].size());
            maker.json["nodes"].push_back({{"extensions", {{"EXT_lights_ies", use}}}});
        }
        return maker;
    }
};

TEST_F(GltfIes, LightsShineAsTheirFilesSay) {
    GltfMaker maker = made({{{"uri", "lamp.ies"}}},
                           {{{"light", 0}}, {{"light", 0}, {"multiplier", 2.5}, {"color", {1, 0.5, 0}}}});
    const double root = std::sqrt(0.5);
    maker.json["nodes"][1]["translation"] = {1, 2, 3};
    maker.json["nodes"][2]["rotation"] = {-root, 0, 0, root}; // down
    maker.json["nodes"][2]["scale"] = {3, 3, 3};
    const LoadedScene loaded = load(maker);
    const Scene &scene = loaded.scene;
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_TRUE(loaded.meshReports.at(0).warnings.empty());
    EXPECT_TRUE(scene.environment.radiance.pixels().empty()) << "it has lights";
    ASSERT_EQ(scene.profiles.size(), 1u) << "each file is read once";
    EXPECT_EQ(scene.profiles[0].candela, 200.0);
    EXPECT_EQ(scene.profiles[0].shares, (std::vector<float>{0.4f, 1.0f, 0.05f}));
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::Point);
    EXPECT_EQ(scene.lights[0].profile, 0u);
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.lights[0].direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(scene.lights[0].c0, glm::dvec3(1, 0, 0));
    EXPECT_NEAR(scene.lights[0].power.x, 4.0 * std::numbers::pi * 200.0, 1e-9);
    const Light &second = scene.lights[1];
    EXPECT_NEAR(glm::distance(second.direction, {0, -1, 0}), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(second.c0, {1, 0, 0}), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(second.power, 4.0 * std::numbers::pi * 500.0 * glm::dvec3(1, 0.5, 0)), 0.0,
                1e-9);
}

TEST_F(GltfIes, ViewsAndDataAreReadAsFilesAre) {
    const std::string data = "data:application/x-ies-lm-63;base64,"
                             "VElMVD1OT05FCjEgMSAxIDIgMSAxIDIgMCAwIDAgMSAxIDEgMCA5MCAwIDEwMCA1MAo=";
    GltfMaker maker = made({{{"bufferView", 1}, {"mimeType", "application/x-ies-lm-63"}}, {{"uri", data}}},
                           {{{"light", 0}}, {{"light", 1}}, {{"light", 0}}});
    const std::size_t view = maker.addView(lampText);
    maker.json["extensions"]["EXT_lights_ies"]["lights"][0]["bufferView"] = view;
    const Scene scene = load(maker).scene;
    ASSERT_EQ(scene.profiles.size(), 2u);
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.profiles[0].shares, (std::vector<float>{0.4f, 1.0f, 0.05f}));
    EXPECT_EQ(scene.profiles[1].shares, (std::vector<float>{1.0f, 0.5f}));
    EXPECT_EQ(scene.lights[1].profile, 1u);
    EXPECT_EQ(scene.lights[2].profile, 0u);
}

TEST_F(GltfIes, FaultsAreRefusedWithTheirPlace) {
    const auto refused = [&](const nlohmann::json &lights, const nlohmann::json &use,
                             const std::string &part) {
        const std::string found = refusal(made(lights, {use}));
        EXPECT_NE(found.find(part), std::string::npos) << found;
    };
    refused({{{"uri", "lamp.ies"}}}, {{"light", 1}}, "/nodes/1/extensions/EXT_lights_ies/light: found 1");
    refused(nlohmann::json::array(), {{"light", 0}}, "/nodes/1/extensions/EXT_lights_ies/light");
    refused({{{"name", "a"}}}, {{"light", 0}}, "/extensions/EXT_lights_ies/lights/0: a light with neither");
    refused({{{"uri", "none.ies"}}}, {{"light", 0}}, "/extensions/EXT_lights_ies/lights/0/uri");
    refused({{{"uri", "../lamp.ies"}}}, {{"light", 0}}, "/extensions/EXT_lights_ies/lights/0/uri");
    refused({{{"bufferView", 99}}}, {{"light", 0}}, "/extensions/EXT_lights_ies/lights/0/bufferView");
}

TEST_F(GltfIes, AMultiplierBelowZeroCountsAsZero) {
    const LoadedScene loaded = load(made({{{"uri", "lamp.ies"}}}, {{{"light", 0}, {"multiplier", -1}}}));
    EXPECT_EQ(loaded.scene.lights.at(0).power, glm::dvec3(0.0));
    EXPECT_EQ(loaded.meshReports.at(0).warnings.size(), 1u);
}

} // namespace
} // namespace hyalite::core
