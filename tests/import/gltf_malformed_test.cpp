// glTF: malformed files are refused with the place in their JSON.
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <functional>

namespace hyalite::core {
namespace {

class GltfMalformed : public GltfFolder {
  protected:
    /// The refusal of a file of one triangle after a change.
    [[nodiscard]] std::string changed(const std::function<void(nlohmann::json &)> &change) const {
        GltfMaker maker = oneTriangle();
        change(maker.json);
        return refusal(maker);
    }
};

TEST_F(GltfMalformed, ContainersAreRefused) {
    const std::string glb = oneTriangle().glb();
    EXPECT_TRUE(refusalOf(write("a.glb", glb)).empty());
    EXPECT_NE(refusalOf(write("a.glb", glb.substr(0, glb.size() - 4))).find("its header says"),
              std::string::npos);
    std::string version = glb;
    version[4] = 1;
    EXPECT_NE(refusalOf(write("a.glb", version)).find("GLB of version 1; allowed: 2, which `assimp export"),
              std::string::npos);
    std::string chunk = glb;
    chunk[15] = 'x';
    EXPECT_NE(refusalOf(write("a.glb", chunk)).find("the chunk at byte 12"), std::string::npos);
    try {
        static_cast<void>(loadGltf(write("a.gltf", "{\"asset\": }"), {}));
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::BadInput);
        EXPECT_NE(std::string(error.what()).find("a.gltf:1:11"), std::string::npos) << error.what();
    }
}

TEST_F(GltfMalformed, OtherVersionsAreRefused) {
    EXPECT_EQ(changed([](auto &json) { json["asset"]["version"] = 2.0; }), "");
    EXPECT_TRUE(
        changed([](auto &json) { json["asset"]["version"] = "1.0"; }).starts_with("/asset/version: "));
    EXPECT_TRUE(
        changed([](auto &json) { json["asset"]["minVersion"] = "2.1"; }).starts_with("/asset/minVersion: "));
    EXPECT_TRUE(changed([](auto &json) { json.erase("asset"); }).starts_with("/asset: missing"));
}

TEST_F(GltfMalformed, UnknownExtensionsAreRefusedWhereRequiredAndToldWhereUsed) {
    EXPECT_EQ(changed([](auto &json) {
                  json["extensionsRequired"] = {"EXT_meshopt_compression", "ACME_x"};
              }).substr(0, 42),
              "/extensionsRequired/1: found \"ACME_x\"; all");
    GltfMaker maker = oneTriangle();
    maker.json["extensionsUsed"] = {"ACME_x", "KHR_materials_ior", "ACME_y"};
    const LoadedScene loaded = load(maker);
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(loaded.meshReports[0].warnings[0].find("\"ACME_x\", \"ACME_y\""), std::string::npos);
}

TEST_F(GltfMalformed, AccessorsOutsideTheirViewsAreRefused) {
    const auto accessor = [](auto key, auto value) {
        return [=](nlohmann::json &json) { json["accessors"][0][key] = value; };
    };
    EXPECT_TRUE(changed(accessor("byteOffset", 4)).starts_with("/accessors/0/bufferView: "));
    EXPECT_TRUE(changed(accessor("byteOffset", 1e15)).starts_with("/accessors/0/byteOffset: "));
    EXPECT_TRUE(changed(accessor("byteOffset", -4)).starts_with("/accessors/0/byteOffset: "));
    EXPECT_TRUE(changed(accessor("byteOffset", 0.5)).starts_with("/accessors/0/byteOffset: "));
    EXPECT_TRUE(changed(accessor("count", 4)).starts_with("/accessors/0/bufferView: "));
    EXPECT_TRUE(changed(accessor("count", 4294967295.0)).starts_with("/accessors/0/bufferView: "));
    EXPECT_TRUE(changed(accessor("count", 1e300)).starts_with("/accessors/0/count: "));
    EXPECT_TRUE(changed(accessor("count", 0)).starts_with("/accessors/0/count: "));
    EXPECT_TRUE(changed(accessor("componentType", 5124)).starts_with("/accessors/0/componentType: "));
    EXPECT_TRUE(changed(accessor("type", "VEC5")).starts_with("/accessors/0/type: "));
    EXPECT_TRUE(changed(accessor("type", "VEC2")).starts_with("/accessors/0/type: "));
    EXPECT_TRUE(changed(accessor("bufferView", 1)).starts_with("/accessors/0/bufferView: "));
    EXPECT_TRUE(changed([](auto &json) {
                    json["accessors"][0].erase("bufferView");
                    json["accessors"][0]["count"] = 4294967295.0;
                }).starts_with("/accessors/0/count: "));
}

TEST_F(GltfMalformed, ViewsOutsideTheirBuffersAreRefused) {
    const auto view = [](auto key, auto value) {
        return [=](nlohmann::json &json) { json["bufferViews"][0][key] = value; };
    };
    EXPECT_TRUE(changed(view("byteOffset", 4)).starts_with("/bufferViews/0/byteLength: "));
    EXPECT_TRUE(changed(view("byteOffset", 1e9)).starts_with("/bufferViews/0/byteOffset: "));
    EXPECT_TRUE(changed(view("byteLength", 37)).starts_with("/bufferViews/0/byteLength: "));
    EXPECT_TRUE(changed(view("byteStride", 3)).starts_with("/bufferViews/0/byteStride: "));
    EXPECT_TRUE(changed(view("buffer", 7)).starts_with("/bufferViews/0/buffer: "));
}

TEST_F(GltfMalformed, BuffersThatAreMissingOrShortAreRefused) {
    const GltfMaker maker = oneTriangle();
    EXPECT_NE(refusalOf(write("a.gltf", maker.finished("none.bin").dump())).find("/buffers/0/uri: "),
              std::string::npos);
    EXPECT_NE(refusalOf(write("a.gltf", maker.finished("../none.bin").dump())).find("allowed: files in"),
              std::string::npos);
    static_cast<void>(write("short.bin", maker.bytes.substr(1)));
    EXPECT_TRUE(refusalOf(write("a.gltf", maker.finished("short.bin").dump()))
                    .starts_with("/buffers/0/byteLength: "));
    EXPECT_TRUE(refusalOf(write("a.gltf", maker.finished("").dump())).starts_with("/buffers/0/byteLength: "));
    for (const char *uri :
         {"data:application/octet-stream;base64,&&&&", "data:text/plain,hello", "http://example.org/a.bin"})
        EXPECT_TRUE(refusalOf(write("a.gltf", maker.finished(uri).dump())).starts_with("/buffers/0/uri: "))
            << uri;
}

TEST_F(GltfMalformed, NumbersThatAreNotFiniteAreRefused) {
    for (const double bad : {std::nan(""), static_cast<double>(INFINITY)}) {
        GltfMaker maker;
        const std::size_t positions = maker.addVec3({0, 0, 0, 1, bad, 0, 0, 1, 0});
        maker.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
        EXPECT_TRUE(refusal(maker).starts_with("/accessors/0: component 1 of element 1 is "))
            << refusal(maker);
    }
}

TEST_F(GltfMalformed, IndicesOutOfRangeAreRefused) {
    GltfMaker maker = oneTriangle();
    maker.json["meshes"][0]["primitives"][0]["indices"] = maker.addIndices({0, 1, 3});
    EXPECT_TRUE(refusal(maker).starts_with("/accessors/1: index 2 is 3; allowed: less than 3"));
    EXPECT_TRUE(changed([](auto &json) {
                    json["meshes"][0]["primitives"][0]["indices"] = 9;
                }).starts_with("/meshes/0/primitives/0/indices: "));
    EXPECT_TRUE(changed([](auto &json) {
                    json["meshes"][0]["primitives"][0]["indices"] = 0;
                }).starts_with("/accessors/0/type: "));
    EXPECT_TRUE(changed([](auto &json) {
                    json["meshes"][0]["primitives"][0]["mode"] = 7;
                }).starts_with("/meshes/0/primitives/0/mode: "));
}

TEST_F(GltfMalformed, CirclesOfNodesAndSecondParentsAreRefused) {
    EXPECT_TRUE(changed([](auto &json) {
                    json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
                }).starts_with("/nodes/0: the node is its own ancestor"));
    EXPECT_TRUE(changed([](auto &json) {
                    json["nodes"] = {{{"children", {0}}}};
                }).starts_with("/nodes/0: the node is its own ancestor"));
    EXPECT_TRUE(changed([](auto &json) {
                    json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, nlohmann::json::object()};
                }).starts_with("/nodes/1/children: node 2 is a child of node 0"));
    EXPECT_TRUE(changed([](auto &json) {
                    json["scenes"][0]["nodes"] = {0, 0};
                }).starts_with("/scenes/0/nodes: node 0 is named twice"));
    EXPECT_TRUE(
        changed([](auto &json) { json["scenes"][0]["nodes"] = {5}; }).starts_with("/scenes/0/nodes/0: "));
    EXPECT_TRUE(changed([](auto &json) { json["nodes"][0]["mesh"] = 1; }).starts_with("/nodes/0/mesh: "));
}

TEST_F(GltfMalformed, DeepTreesOfNodesAreRead) {
    GltfMaker maker = oneTriangle();
    constexpr int depth = 20000;
    maker.json["nodes"] = nlohmann::json::array();
    for (int i = 0; i + 1 < depth; ++i)
        maker.json["nodes"].push_back({{"children", {i + 1}}});
    maker.json["nodes"].push_back({{"mesh", 0}});
    EXPECT_EQ(load(maker).scene.meshes.size(), 1u);
}

TEST_F(GltfMalformed, SmallFilesThatTakeMuchMemoryAreRefused) {
    GltfMaker maker;
    const std::size_t positions = maker.addVec3(std::vector<double>(std::size_t{3} << 16));
    const nlohmann::json primitive = {{"attributes", {{"POSITION", positions}}}};
    nlohmann::json primitives = nlohmann::json::array();
    for (int i = 0; i < 2000; ++i)
        primitives.push_back(primitive);
    maker.json["meshes"] = {{{"primitives", primitives}}};
    EXPECT_NE(refusal(maker).find("bytes of memory besides"), std::string::npos);
}

} // namespace
} // namespace hyalite::core
