// glTF: what has one meaning is read, though the specification forbids it, and a warning says what was changed.
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hyalite::core {
namespace {

class GltfTolerance : public GltfFolder {
  protected:
    [[nodiscard]] static const std::vector<std::string> &warningsOf(const LoadedScene &loaded) {
        return loaded.meshReports.at(0).warnings;
    }
    /// One warning, which has these parts.
    static void expectWarning(const LoadedScene &loaded, std::initializer_list<std::string_view> parts) {
        ASSERT_EQ(warningsOf(loaded).size(), 1u);
        for (const std::string_view part : parts)
            EXPECT_NE(warningsOf(loaded)[0].find(part), std::string::npos) << warningsOf(loaded)[0];
    }
    [[nodiscard]] LoadedScene loadText(const std::string &bytes) const {
        return loadGltf(write("scene.glb", bytes), {});
    }
};

std::string word(std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    return {reinterpret_cast<const char *>(&number), 4};
}

/// A triangle's .glb from its parts: JSON and data as they are, what lies between, and the length of the header less
/// that of the file.
std::string glbOf(const std::string &json, const std::string &between, const std::string &data,
                  const std::string &behind, int excess = 0) {
    const std::string chunks = word(json.size()) + "JSON" + json + between + word(data.size()) +
                               std::string("BIN\0", 4) + data + behind;
    return "glTF" + word(2) + word(static_cast<std::size_t>(12 + static_cast<int>(chunks.size()) + excess)) +
           chunks;
}

TEST_F(GltfTolerance, ChunksOfAnyLengthAreRead) {
    const GltfMaker maker = oneTriangle();
    std::string json = maker.finished("").dump();
    while (json.size() % 4 != 1)
        json += ' ';
    const std::string odd = maker.bytes + "x";
    for (const std::string &between : {std::string(), std::string(3, '\0'), std::string(3, ' ')}) {
        const LoadedScene loaded = loadText(glbOf(json, between, odd, ""));
        EXPECT_EQ(loaded.scene.meshes.size(), 1u);
        EXPECT_TRUE(warningsOf(loaded).empty()) << warningsOf(loaded)[0];
    }
    json += std::string(3, '\0'); // instead of blanks
    EXPECT_EQ(loadText(glbOf(json, "", maker.bytes, "")).scene.meshes.size(), 1u);
}

TEST_F(GltfTolerance, LengthsOfFilesMayBeWrongIfChunksAreWhole) {
    const GltfMaker maker = oneTriangle();
    std::string json = maker.finished("").dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    for (const int excess : {-30, -1, 2, 1000}) {
        const LoadedScene loaded = loadText(glbOf(json, "", maker.bytes, "", excess));
        EXPECT_EQ(loaded.scene.meshes.size(), 1u);
        expectWarning(loaded, {"chunks are read by their own lengths"});
    }
    for (const std::string &behind : {std::string(1, '\n'), std::string(100, 'x')}) {
        const LoadedScene loaded =
            loadText(glbOf(json, "", maker.bytes, behind, -static_cast<int>(behind.size())));
        EXPECT_EQ(loaded.scene.meshes.size(), 1u);
        EXPECT_EQ(warningsOf(loaded).size(), 1u);
    }
    // Without its last padding.
    std::string shortened = glbOf(json, "", maker.bytes + std::string(3, '\0'), "");
    shortened.resize(shortened.size() - 3);
    EXPECT_EQ(loadText(shortened).scene.meshes.size(), 1u);
    shortened.resize(shortened.size() - 1);
    EXPECT_NE(refusalOf(write("a.glb", shortened)).find("ends behind the file"), std::string::npos);
}

TEST_F(GltfTolerance, NullCountsAsAbsent) {
    GltfMaker maker = oneTriangle();
    maker.json["nodes"][0]["camera"] = nullptr;
    maker.json["nodes"][0]["rotation"] = nullptr;
    maker.json["nodes"][0]["name"] = nullptr;
    maker.json["skins"] = nullptr;
    maker.json["meshes"][0]["primitives"][0]["material"] = nullptr;
    maker.json["accessors"][0]["byteOffset"] = nullptr;
    const LoadedScene loaded = load(maker);
    EXPECT_EQ(loaded.scene.meshes.size(), 1u);
    EXPECT_TRUE(warningsOf(loaded).empty()) << warningsOf(loaded)[0];
    maker.json["accessors"][0]["count"] = nullptr;
    EXPECT_TRUE(refusal(maker).starts_with("/accessors/0/count: missing")) << refusal(maker);
    maker.json["nodes"][0]["children"] = {nullptr};
    EXPECT_TRUE(refusal(maker).starts_with("/nodes/0/children/0: ")) << refusal(maker);
}

TEST_F(GltfTolerance, OtherFilesAreNamed) {
    const auto refusalOfText = [&](const std::string &text) { return refusalOf(write("a.gltf", text)); };
    EXPECT_NE(refusalOfText("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n")
                  .find("a pointer of Git LFS: fetch the file itself (git lfs pull)"),
              std::string::npos);
    for (const char *page : {"<!DOCTYPE html>\n<title>", "\xef\xbb\xbf\n<!doctype HTML>", "  <html lang=en>"})
        EXPECT_NE(refusalOfText(page).find("a web page: download the file itself"), std::string::npos)
            << page;
    EXPECT_NE(refusalOfText("\x1f\x8b\x08....").find("gzip data"), std::string::npos);
}

TEST_F(GltfTolerance, RotationsAreNormalised) {
    GltfMaker maker = oneTriangle();
    maker.json["scenes"][0]["nodes"] = {0, 1, 2};
    maker.json["nodes"][0]["rotation"] = {0, 0, 1.0000001, 0}; // half a turn about z
    maker.json["nodes"].push_back({{"rotation", {0, 0, 0, 2}}});
    maker.json["nodes"].push_back({{"rotation", {0, 0, 0.6, 0.8}}});
    const LoadedScene loaded = load(maker);
    EXPECT_NEAR(cornersOf(loaded.scene.meshes.at(0)).at(1).x, -1.0, 1e-6);
    expectWarning(loaded,
                  {"/nodes/0/rotation: a rotation of length 1.0000001 is normalised", " (and 1 more)"});
    maker.json["nodes"][1]["rotation"] = {0, 0, 0, 0};
    EXPECT_TRUE(refusal(maker).starts_with("/nodes/1/rotation: ")) << refusal(maker);
}

TEST_F(GltfTolerance, TheLastRowOfAMatrixIsRounded) {
    GltfMaker maker = oneTriangle();
    maker.json["nodes"][0]["matrix"] = {1, 0, 0, 1e-8, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1.0000001};
    EXPECT_EQ(cornersOf(load(maker).scene.meshes.at(0)).at(0), glm::vec3(5, 0, 0));
    maker.json["nodes"][0]["matrix"][15] = 2; // a scale, or a mistake
    EXPECT_TRUE(refusal(maker).starts_with("/nodes/0/matrix: ")) << refusal(maker);
}

TEST_F(GltfTolerance, FactorsAreClamped) {
    GltfMaker maker = oneTriangle();
    maker.json["meshes"][0]["primitives"][0]["material"] = 0;
    maker.json["materials"] = {nlohmann::json::parse(R"({"emissiveFactor": [2, 0.5, -0.1], "alphaCutoff": -1,
        "alphaMode": "MASK", "pbrMetallicRoughness": {"metallicFactor": 1.0000001, "roughnessFactor": -0.1,
        "baseColorFactor": [1.5, 0.5, 0, 1]}, "extensions": {"KHR_materials_ior": {"ior": 0.99999},
        "KHR_materials_clearcoat": {"clearcoatFactor": 3}, "KHR_materials_sheen": {"sheenColorFactor": [0, 0, 9]},
        "KHR_materials_transmission": {"transmissionFactor": 1.1},
        "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 7,
            "diffuseTransmissionColorFactor": [-1, 0.5, 2]},
        "KHR_materials_iridescence": {"iridescenceFactor": 1.5, "iridescenceIor": 0.8,
            "iridescenceThicknessMaximum": -3, "iridescenceThicknessMinimum": 1e9},
        "KHR_materials_specular": {"specularFactor": -2, "specularColorFactor": [-1, 2, 3]},
        "KHR_materials_emissive_strength": {"emissiveStrength": 4}}})")};
    const LoadedScene loaded = load(maker);
    const Material &material = loaded.scene.materials.at(1);
    EXPECT_EQ(material.emission, glm::vec3(4, 2, 0));
    EXPECT_EQ(material.alphaCutoff, 0.0f);
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 0.0f);
    EXPECT_EQ(material.albedo, glm::vec3(1, 0.5, 0));
    EXPECT_EQ(material.refractiveIndex, 1.0f);
    EXPECT_EQ(material.clearcoat, 1.0f);
    EXPECT_EQ(material.sheenColour, glm::vec3(0, 0, 1));
    EXPECT_EQ(material.transmission, 1.0f);
    EXPECT_EQ(material.diffuseTransmission, 1.0f);
    EXPECT_EQ(material.diffuseTransmissionColour, glm::vec3(0, 0.5f, 1));
    EXPECT_EQ(material.iridescence, 1.0f);
    EXPECT_EQ(material.iridescenceIndex, 1.0f);
    EXPECT_EQ(material.iridescenceThickness, 0.0f);
    EXPECT_EQ(material.iridescenceThicknessMinimum, 1e5f);
    EXPECT_EQ(scatteringOfGltf(material) & layout::scattersAtIridescent, 0u);
    EXPECT_EQ(material.dielectricWeight, 0.0f);
    EXPECT_EQ(material.dielectricColour, glm::vec3(0, 2, 3));
    expectWarning(loaded, {"/materials/0/pbrMetallicRoughness/baseColorFactor/0: 1.5 counts as 1; "
                           "allowed: from 0 to 1",
                           " (and 17 more)"});
    maker.json["materials"][0]["emissiveFactor"] = {1, 1};
    EXPECT_TRUE(refusal(maker).starts_with("/materials/0/emissiveFactor: ")) << refusal(maker);
}

TEST_F(GltfTolerance, ASpotOfEqualAnglesHasAHardEdge) {
    GltfMaker maker = oneTriangle();
    maker.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    nlohmann::json &light = maker.json["extensions"]["KHR_lights_punctual"]["lights"][0];
    light = {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.4}, {"outerConeAngle", 0.4}}}};
    const LoadedScene equal = load(maker);
    EXPECT_EQ(equal.scene.lights.at(0).blend, 0.0);
    EXPECT_TRUE(warningsOf(equal).empty()) << warningsOf(equal)[0];
    light["spot"]["innerConeAngle"] = 0.5;
    light["intensity"] = -1;
    const LoadedScene wider = load(maker);
    EXPECT_EQ(wider.scene.lights.at(0).blend, 0.0);
    EXPECT_EQ(wider.scene.lights[0].power, glm::dvec3(0.0));
    expectWarning(wider, {" (and 1 more)"});
    light["spot"]["outerConeAngle"] = 2;
    EXPECT_NEAR(load(maker).scene.lights.at(0).angleDegrees, 90.0, 1e-12);
    light["spot"]["outerConeAngle"] = 0;
    EXPECT_TRUE(
        refusal(maker).starts_with("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle: found 0"))
        << refusal(maker);
}

TEST_F(GltfTolerance, ElementsNeedNotBeAligned) {
    GltfMaker maker = oneTriangle();
    const std::string positions = maker.bytes;
    maker.bytes = "x" + positions;
    maker.json["bufferViews"][0]["byteLength"] = maker.bytes.size();
    maker.json["bufferViews"][0]["byteStride"] = 0;
    maker.json["accessors"][0]["byteOffset"] = 1;
    EXPECT_EQ(cornersOf(load(maker).scene.meshes.at(0)), cornersOf(load(oneTriangle()).scene.meshes.at(0)));
}

TEST_F(GltfTolerance, JointsOfNoWeightMayBeAny) {
    GltfMaker maker = oneTriangle();
    nlohmann::json &attributes = maker.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = maker.add<std::uint8_t>("VEC4", 5121, 4, {0, 9, 9, 9, 0, 0, 0, 0, 0, 0, 0, 0});
    attributes["WEIGHTS_0"] = maker.addVec4({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    maker.json["skins"] = {{{"joints", {1}}}};
    maker.json["nodes"][0]["skin"] = 0;
    maker.json["nodes"].push_back(nlohmann::json::object());
    maker.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(load(maker).scene.meshes.size(), 1u);
}

TEST_F(GltfTolerance, AShapeThatNoImageHasIsPassedOver) {
    GltfMaker maker = oneTriangle();
    maker.json["nodes"][0]["camera"] = 0;
    nlohmann::json &camera = maker.json["cameras"][0];
    camera = {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"aspectRatio", 1.5}}}};
    EXPECT_EQ(load(maker).aspectRatio, 1.5);
    for (const double ratio : {0.0, -1.0}) {
        camera["perspective"]["aspectRatio"] = ratio;
        const LoadedScene loaded = load(maker);
        EXPECT_EQ(loaded.aspectRatio, std::nullopt);
        expectWarning(loaded, {"/cameras/0/perspective/aspectRatio: "});
    }
    camera = {{"type", "orthographic"},
              {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 1}}}};
    EXPECT_EQ(load(maker).aspectRatio, 1.5);
    camera["orthographic"]["ymag"] = 0;
    EXPECT_EQ(load(maker).aspectRatio, std::nullopt);
}

} // namespace
} // namespace hyalite::core
