// glTF files that a scene file places.
#include "host/import/scene_json.h"
#include "host/scene/validate.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

class GltfPlace : public GltfFolder {
  protected:
    void SetUp() override {
        GltfFolder::SetUp();
        std::filesystem::create_directories(folder / "models");
    }

    [[nodiscard]] LoadedScene place(const GltfMaker &maker, const std::string &mesh) const {
        static_cast<void>(write("models/a.glb", maker.glb()));
        LoadedScene loaded = loadSceneFile(
            write("scene.json",
                  R"({"materials": {"clay": {"type": "diffuse"}}, "meshes": [{"file": "models/a.glb")" +
                      mesh + "}]}"));
        validateScene(loaded.scene, "scene.json");
        return loaded;
    }
};

/// A triangle seen by a node, or by several.
GltfMaker seenAt(const std::vector<double> &places) {
    GltfMaker maker = oneTriangle();
    maker.json["materials"] = {{{"name", "red"}}};
    maker.json["meshes"][0]["primitives"][0]["material"] = 0;
    maker.json["nodes"] = nlohmann::json::array();
    maker.json["scenes"][0]["nodes"] = nlohmann::json::array();
    for (const double x : places) {
        maker.json["scenes"][0]["nodes"].push_back(maker.json["nodes"].size());
        maker.json["nodes"].push_back({{"mesh", 0}, {"translation", {x, 0, 0}}});
    }
    return maker;
}

TEST_F(GltfPlace, HasItsMaterialsAndTheTransformsOfBothFiles) {
    const LoadedScene loaded = place(
        seenAt({3}), R"(, "scale": 2, "translate": [0, 1, 0], "transform": [{"translate": [0, 0, 5]}])");
    const TriangleMesh &mesh = loaded.scene.meshes.at(0);
    EXPECT_EQ(cornersOf(mesh), (std::vector<glm::vec3>{{6, 1, 5}, {8, 1, 5}, {6, 3, 5}}));
    EXPECT_EQ(loaded.scene.materials.at(mesh.materialOf(0)).name, "red");
    EXPECT_EQ(loaded.scene.materials.at(mesh.materialOf(0)).kind, MaterialKind::Gltf);
}

TEST_F(GltfPlace, IsSeenAtEachOfItsPlacesUnderEachInstance) {
    const LoadedScene loaded = place(
        seenAt({1, 2}),
        R"(, "transform": [{"scale": 10}], "instances": [[{"translate": [0, 0, 7]}], [{"translate": [0, 0, 8]}]])");
    ASSERT_EQ(loaded.scene.instances.size(), 4u);
    EXPECT_EQ(loaded.scene.instances[0].toWorld.offset, glm::vec3(10, 0, 7));
    EXPECT_EQ(loaded.scene.instances[3].toWorld.offset, glm::vec3(20, 0, 8));
    EXPECT_EQ(loaded.scene.prototypes.size(), 1u);
}

TEST_F(GltfPlace, HasItsNodesBelowThatOfItsFile) {
    GltfMaker maker = seenAt({1, 2});
    maker.json["nodes"][1]["name"] = "second";
    maker.json["nodes"].push_back({{"name", "mirrored"}, {"mesh", 0}, {"scale", {-1, 1, 1}}});
    maker.json["nodes"].push_back({{"name", "group"}, {"children", {2}}});
    maker.json["scenes"][0]["nodes"] = {0, 1, 3};
    const Scene scene =
        place(maker, R"(, "instances": [[{"translate": [0, 0, 7]}], [{"translate": [0, 0, 8]}]])").scene;
    ASSERT_EQ(scene.nodes.size(), 5u);
    EXPECT_EQ(scene.nodes[0].kind, NodeKind::Mesh);
    EXPECT_EQ(scene.nodes[0].parent, noNode);
    EXPECT_EQ(scene.nodes[2].name, "second");
    EXPECT_EQ(scene.nodes[2].index, 1u);
    EXPECT_EQ(scene.nodes[2].parent, 0u);
    EXPECT_EQ(scene.nodes[4].name, "mirrored");
    EXPECT_EQ(scene.nodes[4].index, 2u);
    EXPECT_EQ(scene.nodes[scene.nodes[4].parent].name, "group");
    std::vector<std::string> names;
    for (const Instance &instance : scene.instances)
        names.push_back(scene.nodes.at(instance.node).name);
    EXPECT_EQ(names, (std::vector<std::string>{"", "second", "mirrored", "", "second", "mirrored"}));
    const Scene once = place(seenAt({0}), "").scene;
    EXPECT_EQ(once.meshes.at(0).node, 1u);
}

TEST_F(GltfPlace, TakesMaterialsOfTheSceneInPlaceOfItsOwn) {
    const LoadedScene overridden = place(seenAt({0}), R"(, "materialOverrides": {"red": "clay"})");
    EXPECT_EQ(overridden.scene.materials.at(overridden.scene.meshes.at(0).materialOf(0)).name, "clay");
    const LoadedScene named = place(seenAt({0}), R"(, "material": "clay")");
    EXPECT_EQ(named.scene.materials.at(named.scene.meshes.at(0).materialOf(0)).name, "clay");
    EXPECT_EQ(named.scene.materials.size(), 1u);
}

TEST_F(GltfPlace, LeavesOutItsCamerasAndLightsWithAWarning) {
    GltfMaker maker = seenAt({0});
    maker.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    maker.json["nodes"][0]["camera"] = 0;
    const LoadedScene loaded = place(maker, "");
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(loaded.meshReports[0].warnings[0].find("cameras and lights are left out"), std::string::npos);
    EXPECT_TRUE(loaded.scene.environment.radiance.pixels().empty());
}

TEST_F(GltfPlace, FindsItsBuffersBesideItself) {
    const GltfMaker maker = oneTriangle();
    static_cast<void>(write("models/a.bin", maker.bytes));
    static_cast<void>(write("models/a.gltf", maker.finished("a.bin").dump()));
    const LoadedScene loaded =
        loadSceneFile(write("scene.json", R"({"meshes": [{"file": "models/a.gltf"}]})"));
    EXPECT_EQ(loaded.scene.meshes.size(), 1u);
    EXPECT_EQ(loaded.meshReports.at(0).files.size(), 2u);
}

} // namespace
} // namespace hyalite::core
