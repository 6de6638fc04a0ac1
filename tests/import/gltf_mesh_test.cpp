// glTF: containers, accessors, primitives, nodes and instances.
#include "host/import/load.h"
#include "host/scene/instances.h"
#include "tests/fixtures/gltf_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace hyalite::core {
namespace {

class GltfMesh : public GltfFolder {};

const std::vector<glm::vec3> rightTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST_F(GltfMesh, ComesFromGlbFromAFileBesideAndFromADataUri) {
    const GltfMaker maker = oneTriangle();
    EXPECT_EQ(cornersOf(load(maker).scene.meshes.at(0)), rightTriangle);
    static_cast<void>(write("a b.bin", maker.bytes));
    const LoadedScene beside = loadGltf(write("a.gltf", maker.finished("a%20b.bin").dump()), {});
    EXPECT_EQ(cornersOf(beside.scene.meshes.at(0)), rightTriangle);
    EXPECT_EQ(beside.meshReports.at(0).files.size(), 2u);
    const std::string base64 = "data:application/octet-stream;base64,"
                               "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    EXPECT_EQ(cornersOf(loadGltf(write("b.gltf", maker.finished(base64).dump()), {}).scene.meshes.at(0)),
              rightTriangle);
}

TEST_F(GltfMesh, HasTheTrianglesOfEachMode) {
    GltfMaker maker;
    const std::size_t positions = maker.addVec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const auto cornersIn = [&](int mode, const std::vector<double> &indices) {
        GltfMaker made = maker;
        nlohmann::json primitive = {{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
        primitive["indices"] = made.addIndices(indices);
        made.json["meshes"] = {{{"primitives", {primitive}}}};
        return cornersOf(load(made).scene.meshes.at(0));
    };
    const glm::vec3 a(0, 0, 0);
    const glm::vec3 b(1, 0, 0);
    const glm::vec3 c(1, 1, 0);
    const glm::vec3 d(0, 1, 0);
    EXPECT_EQ(cornersIn(4, {0, 1, 2, 0, 2, 3}), (std::vector<glm::vec3>{a, b, c, a, c, d}));
    EXPECT_EQ(cornersIn(5, {0, 1, 3, 2}), (std::vector<glm::vec3>{a, b, d, b, c, d}));
    EXPECT_EQ(cornersIn(6, {0, 1, 2, 3}), (std::vector<glm::vec3>{b, c, a, c, d, a}));
}

TEST_F(GltfMesh, PassesOverPointsAndLinesAndSaysHowMany) {
    GltfMaker maker = oneTriangle();
    nlohmann::json &primitives = maker.json["meshes"][0]["primitives"];
    for (const int mode : {0, 1, 2, 3}) {
        primitives.push_back(primitives[0]);
        primitives.back()["mode"] = mode;
    }
    const LoadedScene loaded = load(maker);
    EXPECT_EQ(cornersOf(loaded.scene.meshes.at(0)), rightTriangle);
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 2u);
    EXPECT_NE(loaded.meshReports[0].warnings[0].find("1 primitives of points"), std::string::npos);
    EXPECT_NE(loaded.meshReports[0].warnings[1].find("3 primitives of lines"), std::string::npos);
}

TEST_F(GltfMesh, KeepsOnlyVerticesThatAreUsedAndDropsTrianglesWithoutArea) {
    GltfMaker maker;
    const std::size_t positions = maker.addVec3({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9});
    const std::size_t indices = maker.addIndices({1, 2, 3, 1, 1, 2});
    maker.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}}};
    const LoadedScene loaded = load(maker);
    EXPECT_EQ(loaded.scene.meshes.at(0).positions, rightTriangle);
    EXPECT_EQ(loaded.meshReports.at(0).degenerateTriangleCount, 1u);
}

TEST_F(GltfMesh, ReadsInterleavedNormalisedAndSparseAccessors) {
    GltfMaker maker;
    // Three vertices of 12 bytes: a position of three bytes and one of padding, texture coordinates, a normal.
    const std::array<unsigned char, 36> bytes{0,   0,   0, 0, 0,   255, 0, 0, 0, 0, 127, 0, //
                                              127, 0,   0, 0, 255, 0,   0, 0, 0, 0, 127, 0, //
                                              0,   127, 0, 0, 51,  102, 0, 0, 0, 0, 127, 0};
    const std::size_t view = maker.addView({reinterpret_cast<const char *>(bytes.data()), bytes.size()}, 12);
    const auto accessor = [&](int componentType, std::size_t offset, const char *type) {
        maker.json["accessors"].push_back({{"bufferView", view},
                                           {"byteOffset", offset},
                                           {"componentType", componentType},
                                           {"normalized", true},
                                           {"count", 3},
                                           {"type", type}});
        return maker.json["accessors"].size() - 1;
    };
    const std::size_t positions = accessor(5120, 0, "VEC3");
    const std::size_t uvs = accessor(5121, 4, "VEC2");
    const std::size_t normals = accessor(5120, 8, "VEC3");
    const std::size_t sparseIndices = maker.addView(std::string("\x02\0\0\0", 4));
    const float moved[3] = {0, 2, 0};
    const std::size_t sparseValues = maker.addView({reinterpret_cast<const char *>(moved), sizeof(moved)});
    maker.json["accessors"].push_back(
        {{"componentType", 5126},
         {"count", 3},
         {"type", "VEC3"},
         {"sparse",
          {{"count", 1},
           {"indices", {{"bufferView", sparseIndices}, {"componentType", 5125}}},
           {"values", {{"bufferView", sparseValues}}}}}});
    maker.json["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
            {"targets", {{{"POSITION", maker.json["accessors"].size() - 1}}}}}}},
         {"weights", {0.5}}}};
    const TriangleMesh mesh = load(maker).scene.meshes.at(0);
    // The sparse target moves the last corner by half of (0, 2, 0).
    EXPECT_EQ(cornersOf(mesh), (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}));
    EXPECT_EQ(mesh.normals.at(0), glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.uvs.at(0), glm::vec2(0, 0)); // v runs up
    EXPECT_EQ(mesh.uvs.at(1), glm::vec2(1, 1));
    EXPECT_NEAR(mesh.uvs.at(2).x, 0.2f, 1e-6f);
    EXPECT_NEAR(mesh.uvs.at(2).y, 0.6f, 1e-6f);
}

TEST_F(GltfMesh, HasColoursAndASecondSetOfCoordinatesWhereAMaterialWantsIt) {
    GltfMaker maker = oneTriangle();
    nlohmann::json &attributes = maker.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] =
        maker.add<std::uint8_t>("VEC4", 5121, 4, {255, 0, 0, 51, 0, 255, 0, 255, 0, 0, 255, 255}, true);
    const TriangleMesh mesh = load(maker).scene.meshes.at(0);
    ASSERT_EQ(mesh.colours.values.size(), 3u);
    EXPECT_EQ(mesh.colours.values[0], glm::vec4(1, 0, 0, 0.2f));
    EXPECT_EQ(mesh.colours.corners.at(0), glm::uvec3(0, 1, 2));
}

TEST_F(GltfMesh, WithoutNormalsIsFlatAndBadNormalsAreReplaced) {
    EXPECT_EQ(load(oneTriangle()).scene.meshes.at(0).triangles.at(0).normals,
              glm::uvec3(MeshTriangle::noNormal));
    GltfMaker maker = oneTriangle();
    maker.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        maker.addVec3({0, 0, 3, 0, 0, 1, 0, 0, 0});
    const LoadedScene loaded = load(maker);
    EXPECT_EQ(loaded.scene.meshes.at(0).triangles.at(0).normals, glm::uvec3(MeshTriangle::noNormal));
    EXPECT_EQ(loaded.meshReports.at(0).lostNormalCount, 1u);
}

TEST_F(GltfMesh, PrimitivesOfAMeshBecomeOneWithTheirMaterials) {
    GltfMaker maker = oneTriangle();
    maker.json["materials"] = {{{"name", "red"}}, {{"name", "green"}}};
    nlohmann::json &primitives = maker.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives.push_back(primitives[0]);
    primitives[0]["material"] = 1;
    primitives[1]["attributes"]["NORMAL"] = maker.addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    primitives[2]["material"] = 0;
    const LoadedScene loaded = load(maker);
    const TriangleMesh &mesh = loaded.scene.meshes.at(0);
    ASSERT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(loaded.scene.materials.at(mesh.materialOf(0)).name, "green");
    EXPECT_EQ(loaded.scene.materials.at(mesh.materialOf(1)).name, "default");
    EXPECT_EQ(loaded.scene.materials.at(mesh.materialOf(2)).name, "red");
    EXPECT_EQ(mesh.triangles[0].normals, glm::uvec3(MeshTriangle::noNormal));
    EXPECT_EQ(mesh.triangles[1].normals, glm::uvec3(0, 1, 2));
}

TEST_F(GltfMesh, IsWhereItsNodesBringIt) {
    GltfMaker maker = oneTriangle();
    // A parent that is twice as large and moved, a child that is turned by 90 degrees about z.
    maker.json["nodes"] = {{{"children", {1}}, {"scale", {2, 2, 2}}, {"translation", {0, 0, 5}}},
                           {{"mesh", 0}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}};
    const std::vector<glm::vec3> corners = cornersOf(load(maker).scene.meshes.at(0));
    const std::vector<glm::vec3> expected{{0, 0, 5}, {0, 2, 5}, {-2, 0, 5}};
    for (std::size_t i = 0; i < 3; ++i)
        for (glm::length_t axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(corners.at(i)[axis], expected[i][axis], 1e-6f);
}

TEST_F(GltfMesh, OfAMirroringNodeKeepsItsOutside) {
    GltfMaker maker = oneTriangle();
    maker.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        maker.addVec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
    maker.json["nodes"][0]["matrix"] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const TriangleMesh mesh = load(maker).scene.meshes.at(0);
    const std::vector<glm::vec3> c = cornersOf(mesh);
    EXPECT_GT(glm::cross(c[1] - c[0], c[2] - c[0]).z, 0.0f);
    EXPECT_EQ(mesh.normals.at(0), glm::vec3(0, 0, 1));
}

TEST_F(GltfMesh, OfSeveralNodesHasInstances) {
    GltfMaker maker = oneTriangle();
    maker.json["scenes"][0]["nodes"] = {0, 1, 2};
    maker.json["nodes"] = {
        {{"mesh", 0}}, {{"mesh", 0}, {"translation", {3, 0, 0}}}, {{"mesh", 0}, {"scale", {0, 1, 1}}}};
    const LoadedScene loaded = load(maker);
    EXPECT_TRUE(loaded.scene.meshes.empty());
    ASSERT_EQ(loaded.scene.instances.size(), 2u);
    EXPECT_EQ(loaded.scene.instances[1].toWorld.offset, glm::vec3(3, 0, 0));
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(loaded.meshReports[0].warnings[0].find("/nodes/2: the mesh is flattened"), std::string::npos);
}

TEST_F(GltfMesh, InstancingPlacesItManyTimes) {
    GltfMaker maker = oneTriangle();
    maker.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    maker.json["nodes"][0]["translation"] = {0, 0, 1};
    const std::size_t translations = maker.addVec3({1, 0, 0, 2, 0, 0, 3, 0, 0});
    maker.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translations}};
    const LoadedScene loaded = load(maker);
    ASSERT_EQ(loaded.scene.instances.size(), 3u);
    EXPECT_EQ(loaded.scene.instances[2].toWorld.offset, glm::vec3(3, 0, 1));
    EXPECT_TRUE(loaded.meshReports.at(0).warnings.empty())
        << ::testing::PrintToString(loaded.meshReports.at(0).warnings);
}

TEST_F(GltfMesh, OfTheChosenSceneAlone) {
    GltfMaker maker = oneTriangle();
    maker.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {7, 0, 0}}}};
    maker.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}, {"name", "other"}}};
    EXPECT_EQ(cornersOf(load(maker).scene.meshes.at(0)).at(0).x, 0.0f);
    for (const char *choice : {"other", "1"})
        EXPECT_EQ(cornersOf(load(maker, {.gltfScene = choice}).scene.meshes.at(0)).at(0).x, 7.0f);
    try {
        static_cast<void>(load(maker, {.gltfScene = "third"}));
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::Usage);
        EXPECT_NE(std::string(error.what()).find("\"other\""), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace hyalite::core
