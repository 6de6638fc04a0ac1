// glTF: primitives compressed by Draco, views compressed by meshoptimizer.
#include "tests/fixtures/gltf_fixture.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

class GltfCompression : public GltfFolder {};

std::string fromHex(std::string_view digits) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
    return bytes;
}

// A unit square of two triangles, by the encoder of Draco 1.5.5: positions in 8 bits, attribute 0.
constexpr std::string_view dracoSquare = "445241434f02020101000000040200020000011fff011101ff00000100090300000"
                                         "20101010003030130011003002882980000000000"
                                         "ff0000000000000000000000000000000000803f08";
// The same by meshoptimizer 0.18: four positions, and indices as triangles and as a sequence.
constexpr std::string_view packedPositions = "a000000133000000ffff01330000007e7d0000010c000000ff010c0000007e0"
                                             "000000000000000000000000000000000000000000000"
                                             "00000000000000000000000000";
constexpr std::string_view packedTriangles = "e0f000007687566778a9866589689801690000";
constexpr std::string_view packedSequence = "d000040406080400000000";
// Four normals in octahedral coordinates of 8 bits: +z, +x, +z, +z.
constexpr std::string_view packedNormals =
    "a0013c000000fefd0000000000000000000000000000000000000000000000000000000000000000007f00";

void expectSquare(const TriangleMesh &mesh) {
    const std::vector<glm::vec3> corners = cornersOf(mesh);
    ASSERT_EQ(corners.size(), 6u);
    glm::vec3 low(9.0f);
    glm::vec3 high(-9.0f);
    for (const glm::vec3 &corner : corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    EXPECT_NEAR(high.x - low.x, 1.0f, 1e-6f);
    EXPECT_NEAR(high.y - low.y, 1.0f, 1e-6f);
    EXPECT_EQ(mesh.positions.size(), 4u);
}

GltfMaker dracoMaker() {
    GltfMaker maker;
    const std::size_t view = maker.addView(fromHex(dracoSquare));
    maker.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    maker.json["accessors"] = {{{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
                               {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
    nlohmann::json primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}};
    primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                             {"attributes", {{"POSITION", 0}}}};
    maker.json["meshes"] = {{{"primitives", {primitive}}}};
    return maker;
}

TEST_F(GltfCompression, DracoIsDecoded) { expectSquare(load(dracoMaker()).scene.meshes.at(0)); }

TEST_F(GltfCompression, DracoThatDiffersFromItsAccessorsIsRefused) {
    GltfMaker maker = dracoMaker();
    maker.json["accessors"][0]["count"] = 5;
    EXPECT_TRUE(refusal(maker).starts_with("/accessors/0/count: ")) << refusal(maker);
    maker = dracoMaker();
    maker.json["accessors"][1]["count"] = 9;
    EXPECT_TRUE(refusal(maker).starts_with("/accessors/1/count: ")) << refusal(maker);
    maker = dracoMaker();
    maker.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
              ["POSITION"] = 4;
    EXPECT_NE(refusal(maker).find("the Draco data has no attribute 4"), std::string::npos);
    maker = dracoMaker();
    for (std::size_t i = 20; i < maker.bytes.size(); ++i)
        maker.bytes[i] = '\xff';
    EXPECT_NE(refusal(maker).find("is damaged"), std::string::npos) << refusal(maker);
}

/// Adds a compressed view over a fallback buffer without data.
std::size_t addPacked(GltfMaker &maker, std::string_view digits, std::size_t count, std::size_t stride,
                      const char *mode, const char *filter = "NONE") {
    const std::size_t packed = maker.addView(fromHex(digits));
    const nlohmann::json raw = maker.json["bufferViews"][packed];
    nlohmann::json view = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", count * stride}};
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", raw["byteOffset"]},
                                                     {"byteLength", raw["byteLength"]},
                                                     {"byteStride", stride},
                                                     {"count", count},
                                                     {"mode", mode},
                                                     {"filter", filter}};
    maker.json["bufferViews"].push_back(view);
    return maker.json["bufferViews"].size() - 1;
}

GltfMaker meshoptMaker(std::string_view indices, const char *mode) {
    GltfMaker maker;
    maker.json["buffers"] = {
        {{"byteLength", 1000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    const std::size_t positions = addPacked(maker, packedPositions, 4, 12, "ATTRIBUTES");
    const std::size_t triangles = addPacked(maker, indices, 6, 4, mode);
    const std::size_t normals = addPacked(maker, packedNormals, 4, 4, "ATTRIBUTES", "OCTAHEDRAL");
    maker.json["accessors"] = {
        {{"bufferView", positions}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"bufferView", triangles}, {"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}},
        {{"bufferView", normals},
         {"componentType", 5120},
         {"count", 4},
         {"type", "VEC3"},
         {"normalized", true}}};
    maker.json["bufferViews"][normals]["byteStride"] = 4;
    maker.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 2}}}, {"indices", 1}}}}}};
    return maker;
}

TEST_F(GltfCompression, MeshoptViewsAreDecodedWithoutTheirFallback) {
    const TriangleMesh mesh = load(meshoptMaker(packedTriangles, "TRIANGLES")).scene.meshes.at(0);
    expectSquare(mesh);
    EXPECT_NEAR(mesh.normals.at(mesh.triangles[0].normals.x).z, 1.0f, 0.02f);
    expectSquare(load(meshoptMaker(packedSequence, "INDICES")).scene.meshes.at(0));
}

TEST_F(GltfCompression, MeshoptViewsThatAreDamagedAreRefused) {
    const auto changed = [&](const char *key, const nlohmann::json &value) {
        GltfMaker maker = meshoptMaker(packedTriangles, "TRIANGLES");
        maker.json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"][key] = value;
        return refusal(maker);
    };
    const std::string path = "/bufferViews/1/extensions/EXT_meshopt_compression/";
    EXPECT_TRUE(changed("count", 5).starts_with("/bufferViews/1/byteLength: ")) << changed("count", 5);
    EXPECT_TRUE(changed("count", 4000000000.0).starts_with(path + "count: "));
    EXPECT_TRUE(changed("byteStride", 7).starts_with(path + "byteStride: "));
    EXPECT_TRUE(changed("mode", "POINTS").starts_with(path + "mode: "));
    EXPECT_TRUE(changed("filter", "OCTAHEDRAL").starts_with(path + "filter: "));
    EXPECT_TRUE(changed("buffer", 2).starts_with(path + "buffer: "));
    EXPECT_TRUE(changed("byteLength", 10).starts_with(path + "count: "));
}

} // namespace
} // namespace hyalite::core
