// PLY meshes: every way of writing one square, and what is refused.
#include "host/import/ply.h"

#include "host/import/load.h"
#include "tests/fixtures/png_fixture.h"
#include "tests/fixtures/scene_json_fixture.h"

#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

/// The bytes of a value in either order.
template <class T> std::string bytesOf(T value, bool isBig) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (isBig)
        std::ranges::reverse(bytes);
    return bytes;
}

class Ply : public SceneFolder {
  protected:
    [[nodiscard]] ObjMesh read(const std::string &text) const { return loadPly(write("mesh.ply", text)); }

    [[nodiscard]] std::string refusalOfPly(const std::string &text) const {
        const std::filesystem::path file = write("mesh.ply", text);
        try {
            static_cast<void>(loadPly(file));
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::BadInput);
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with(file.string() + ":")) << message;
            return message.substr(std::min(message.size(), file.string().size()));
        }
        return {};
    }
    void expectRefusal(const std::string &text, const std::vector<std::string> &parts) const {
        const std::string message = refusalOfPly(text);
        for (const std::string &part : parts)
            EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
    }
};

const std::string vertexHead = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faceHead = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
const std::string textHead = "ply\nformat ascii 1.0\n";

void expectSquare(const ObjMesh &loaded) {
    ASSERT_EQ(loaded.mesh.triangles.size(), 2u);
    EXPECT_EQ(loaded.mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(loaded.report.faceCount, 1u);
    EXPECT_EQ(loaded.report.polygonCount, 1u);
    for (const MeshTriangle &triangle : loaded.mesh.triangles) {
        const glm::vec3 a = loaded.mesh.positions[triangle.positions.x];
        const glm::vec3 b = loaded.mesh.positions[triangle.positions.y];
        const glm::vec3 c = loaded.mesh.positions[triangle.positions.z];
        EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0.0f) << "faces +z";
    }
}

TEST_F(Ply, IsReadAsText) { expectSquare(read(textHead + vertexHead + faceHead + square)); }

/// The body of a binary file with `square`.
std::string squareBytes(bool isBig) {
    std::string bytes;
    for (const float number : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
        bytes += bytesOf(number, isBig);
    bytes += '\x04';
    for (const std::int32_t index : {0, 1, 2, 3})
        bytes += bytesOf(index, isBig);
    return bytes;
}

TEST_F(Ply, MayHaveAnyLineEnds) {
    for (const char *end : {"\r\n", "\r"}) {
        std::string text;
        for (const char c : textHead + "comment of a\tprogram\n" + vertexHead + faceHead + square)
            text += c == '\n' ? std::string(end) : std::string(1, c);
        expectSquare(read(text));
    }
    expectSquare(read(textHead + "obj_info num_cols 512\n\nwords of a comment that was broken into lines\n" +
                      vertexHead + faceHead + "0 0 0 9 9\n\n1 0 0\n  1 1 0  \n+0 1e0 0.0\n4 0 1 2 3"));
}

TEST_F(Ply, BytesMayFollowALineEndThatIsNotLikeTheOthers) {
    std::string text = "ply\nformat binary_little_endian 1.0\n" + vertexHead + faceHead;
    text.insert(text.size() - 1, "\r");
    expectSquare(read(text + squareBytes(false)));
}

TEST_F(Ply, HeadersMayBeInAnyLetterCase) {
    std::string head = textHead + vertexHead + faceHead;
    std::ranges::transform(head, head.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    expectSquare(read(head + square));
}

TEST_F(Ply, NumbersTooSmallAreZero) {
    expectSquare(
        read(textHead + vertexHead + faceHead + "0 1e-400 1E-400\n1 0 -1E-400\n1 1 0\n0 1 0\n4 0 1 2 3\n"));
}

TEST_F(Ply, IsReadAsBytesOfEitherOrder) {
    for (const bool isBig : {false, true})
        for (const char *end : {"\n", "\r\n"}) {
            std::string text;
            for (const char c : std::string("ply\nformat binary_") + (isBig ? "big" : "little") +
                                    "_endian 1.0\n" + vertexHead + faceHead)
                text += c == '\n' ? std::string(end) : std::string(1, c);
            expectSquare(read(text + squareBytes(isBig)));
        }
}

TEST_F(Ply, ReadsEveryTypeInEveryOrderAndPassesOverTheRest) {
    std::string text =
        "ply\nformat binary_big_endian 1.0\n"
        "element camera 1\nproperty float view_px\nproperty list uchar short odd\n"
        "element vertex 4\nproperty double confidence\nproperty int8 z\nproperty list int uchar l\n"
        "property uint16 y\nproperty double x\n"
        "element face 1\nproperty list uint32 uint8 vertex_index\nproperty int flags\n"
        "element edge 1\nproperty int vertex1\nend_header\n";
    text += bytesOf(1.5f, true) + '\x02' + bytesOf(std::int16_t{3}, true) + bytesOf(std::int16_t{4}, true);
    const std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (const auto &[x, y] : corners)
        text += bytesOf(0.5, true) + '\0' + bytesOf(std::int32_t{1}, true) + 'x' +
                bytesOf(static_cast<std::uint16_t>(y), true) + bytesOf(static_cast<double>(x), true);
    text +=
        bytesOf(std::uint32_t{4}, true) + std::string("\0\1\2\3", 4) + bytesOf(7, true) + bytesOf(0, true);
    const ObjMesh loaded = read(text);
    expectSquare(loaded);
    EXPECT_EQ(loaded.report.unusedStatementCount, 2u) << "a camera and an edge";
}

TEST_F(Ply, HasColoursNormalsAndTextureCoordinates) {
    const ObjMesh loaded =
        read(textHead + "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                        "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
                        "property uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                        "property float s\nproperty float t\n"
                        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0 0 0 0 2 255 0 188 0 0 0.5\n1 0 0 0 1 0 0 0 0 9 1 0\n0 1 0 1 0 0 255 255 255 "
                        "255 0 1\n3 0 1 2\n");
    const TriangleMesh &mesh = loaded.mesh;
    EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
    EXPECT_EQ(mesh.triangles.at(0).normals, glm::uvec3(0, 1, 2));
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 0.5}, {1, 0}, {0, 1}}));
    ASSERT_EQ(mesh.triangleUvs.size(), 1u);
    EXPECT_EQ(mesh.triangleUvs[0], glm::uvec3(0, 1, 2));
    ASSERT_EQ(mesh.colours.corners.size(), 1u);
    EXPECT_EQ(mesh.colours.corners[0], glm::uvec3(0, 1, 2));
    ASSERT_EQ(mesh.colours.values.size(), 3u);
    EXPECT_EQ(mesh.colours.values[0].x, 1.0f);
    EXPECT_NEAR(mesh.colours.values[0].z, 0.5029f, 1e-3f) << "188 of sRGB is half the light";
    EXPECT_EQ(mesh.colours.values[1], glm::vec4(0, 0, 0, 1)) << "alpha is passed over";
}

TEST_F(Ply, TakesColoursOfFloatsAsLinear) {
    const ObjMesh loaded = read(textHead +
                                "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                "property float r\nproperty float g\nproperty float b\n" +
                                "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                "0 0 0 0.5 0 7\n1 0 0 nan -1 0\n0 1 0 0 0 0\n3 0 1 2\n");
    ASSERT_EQ(loaded.mesh.colours.values.size(), 3u);
    EXPECT_EQ(loaded.mesh.colours.values[0], glm::vec4(0.5f, 0.0f, 1.0f, 1.0f));
    EXPECT_EQ(loaded.mesh.colours.values[1], glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
}

TEST_F(Ply, TextureCoordinatesOfFacesGoBeforeThoseOfVertices) {
    const ObjMesh loaded =
        read(textHead + "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                        "property float u\nproperty float v\n"
                        "element face 2\nproperty list uchar float texcoord\n"
                        "property list uchar int vertex_indices\nend_header\n"
                        "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n6 .1 .2 .3 .4 .5 .6 3 0 1 2\n0 3 0 1 2\n");
    ASSERT_EQ(loaded.mesh.triangleUvs.size(), 2u);
    EXPECT_EQ(loaded.mesh.uvs.at(loaded.mesh.triangleUvs[0].y), glm::vec2(0.3f, 0.4f));
    EXPECT_EQ(loaded.mesh.uvs.at(loaded.mesh.triangleUvs[1].y), glm::vec2(1.0f, 0.0f));
}

TEST_F(Ply, StripsTurnEveryOtherTriangle) {
    const ObjMesh loaded = read(textHead + vertexHead +
                                "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                                "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 3\n");
    ASSERT_EQ(loaded.mesh.triangles.size(), 3u);
    EXPECT_EQ(loaded.mesh.triangles[0].positions, glm::uvec3(0, 1, 2));
    EXPECT_EQ(loaded.mesh.triangles[1].positions, glm::uvec3(2, 1, 3)) << "faces +z as the first does";
    EXPECT_EQ(loaded.mesh.triangles[2].positions, glm::uvec3(0, 1, 3)) << "begins after -1";
}

TEST_F(Ply, FacesMayComeBeforeVertices) {
    expectSquare(read(textHead + "element face 1\nproperty list uchar int vertex_indices\n" + vertexHead +
                      "end_header\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"));
}

TEST_F(Ply, FacesOfFewCornersArePassedOverWithAWarning) {
    const ObjMesh loaded =
        read(textHead + vertexHead + "element face 3\nproperty list uchar int vertex_indices\nend_header\n" +
             square + "2 0 1\n0\n");
    expectSquare(loaded);
    ASSERT_EQ(loaded.report.warnings.size(), 1u);
    EXPECT_NE(
        loaded.report.warnings[0].find(":15: a face with fewer than three corners is left out (and 1 more)"),
        std::string::npos)
        << loaded.report.warnings[0];
}

TEST_F(Ply, AFileThatEndsWithinItsFacesIsReadAsFarAsItGoes) {
    const std::string faces = "element face 3\nproperty list uchar int vertex_indices\nend_header\n";
    const ObjMesh text = read(textHead + vertexHead + faces + square);
    expectSquare(text);
    ASSERT_EQ(text.report.warnings.size(), 1u);
    EXPECT_NE(text.report.warnings[0].find("cut short; what is there is rendered, 1 of 3 rows"),
              std::string::npos)
        << text.report.warnings[0];
    std::string bytes = "ply\nformat binary_little_endian 1.0\n" + vertexHead + faces;
    for (const float number : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
        bytes += bytesOf(number, false);
    bytes += '\x04';
    for (const std::int32_t index : {0, 1, 2, 3})
        bytes += bytesOf(index, false);
    const ObjMesh binary = read(bytes + std::string("\4\0\0", 3));
    expectSquare(binary);
    EXPECT_EQ(binary.report.warnings.size(), 1u);
    expectRefusal(bytes.substr(0, bytes.size() - 1), {"cut short"});
}

TEST_F(Ply, WhatIsNotUsedIsOneWarningAKind) {
    const ObjMesh loaded = read(
        "\xEF\xBB\xBF" + textHead +
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float quality\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
        "element face 1\nproperty list uchar int vertex_indices\nproperty int flags\n"
        "element edge 1\nproperty int vertex1\nend_header\n"
        "0 0 0 1 255 0 0 255\n1 0 0 1 0 0 0 9\n0 1 0 1 0 0 255 0\n3 0 1 2 7\n1\n");
    const char *const parts[] = {
        "the property \"quality\" of the element \"vertex\" is left out (and 1 more)",
        ":19: alpha is left out: colours are opaque (and 1 more)", "the element \"edge\" is left out"};
    ASSERT_EQ(loaded.report.warnings.size(), std::size(parts))
        << ::testing::PrintToString(loaded.report.warnings);
    for (std::size_t i = 0; i < std::size(parts); ++i)
        EXPECT_NE(loaded.report.warnings[i].find(parts[i]), std::string::npos) << loaded.report.warnings[i];
}

TEST_F(Ply, ValuesBehindARowAreToldWithTheirCount) {
    const ObjMesh loaded =
        read(textHead + vertexHead + faceHead + "0 0 0 9\n1 0 0\t\n1 1 0 9 9\n0 1 0\n4 0 1 2 3 7\n");
    expectSquare(loaded);
    ASSERT_EQ(loaded.report.warnings.size(), 1u);
    EXPECT_NE(
        loaded.report.warnings[0].find(
            "mesh.ply:10: what stands behind the values of the element \"vertex\" is left out (and 2 more)"),
        std::string::npos)
        << loaded.report.warnings[0];
}

TEST_F(Ply, ColoursOfInt8AreBytes) {
    const auto withType = [](const std::string &type, const char *colour) {
        return textHead +
               "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty " + type +
               " red\nproperty " + type + " green\nproperty " + type + " blue\n" + faceHead + "0 0 0 " +
               colour + "\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n";
    };
    const ObjMesh wrapped = read(withType("int8", "-56 100 -1"));
    EXPECT_TRUE(wrapped.report.warnings.empty());
    const ObjMesh bytes = read(withType("uint8", "200 100 255"));
    EXPECT_EQ(wrapped.mesh.colours.values, bytes.mesh.colours.values);
    EXPECT_EQ(wrapped.mesh.colours.values.at(0).z, 1.0f);
}

TEST_F(Ply, FacesMayHaveColours) {
    const std::string faces = "element face 3\nproperty list uchar int vertex_indices\nproperty uchar red\n"
                              "property uchar green\nproperty uchar blue\n";
    const std::string rows = "3 0 1 2 255 0 0\n4 0 1 2 3 0 255 0\n3 0 2 3 0 255 0\n";
    const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    for (const bool areFirst : {false, true}) {
        const ObjMesh loaded = read(textHead + (areFirst ? faces + vertexHead : vertexHead + faces) +
                                    "end_header\n" + (areFirst ? rows + corners : corners + rows));
        ASSERT_EQ(loaded.mesh.triangles.size(), 4u);
        ASSERT_EQ(loaded.mesh.colours.corners.size(), 4u);
        EXPECT_TRUE(loaded.report.warnings.empty());
        const auto colourOf = [&](std::size_t triangle) {
            return loaded.mesh.colours.values.at(loaded.mesh.colours.corners[triangle].z);
        };
        EXPECT_EQ(colourOf(0), glm::vec4(1, 0, 0, 1));
        for (std::size_t triangle = 1; triangle < 4; ++triangle)
            EXPECT_EQ(colourOf(triangle), glm::vec4(0, 1, 0, 1));
    }
}

TEST_F(Ply, HasTheTexturesOfItsHeader) {
    static_cast<void>(write("my scan.png", onePixelPng(200, 100, 50)));
    const std::string vertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                                 "property float s\nproperty float t\n";
    const std::string rows = "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n";
    const LoadedScene one = loadScene(write("a.ply", textHead + "comment TextureFile  my scan.png \n" +
                                                         vertices + faceHead + rows + "4 0 1 2 3\n")
                                          .string());
    ASSERT_EQ(one.scene.materials.size(), 2u);
    EXPECT_EQ(one.scene.materials[1].albedo, glm::vec3(1.0f));
    EXPECT_TRUE(one.scene.materials[1].textures[layout::slotBaseColour]);
    EXPECT_TRUE(one.scene.materials[1].twoSided);
    EXPECT_EQ(one.scene.meshes.at(0).triangleMaterials, (std::vector<std::uint32_t>{1, 1}));
    EXPECT_TRUE(one.meshReports.at(0).warnings.empty());
    const LoadedScene several = loadScene(
        write("b.ply", textHead +
                           "comment TextureFile C:\\scans\\lost.png\ncomment TextureFile my scan.png\n" +
                           vertices +
                           "element face 3\nproperty list uchar int vertex_indices\nproperty int "
                           "texnumber\nend_header\n" +
                           rows + "3 0 1 2 1\n3 0 2 3 0\n3 0 1 3 -1\n")
            .string());
    ASSERT_EQ(several.scene.materials.size(), 3u);
    EXPECT_FALSE(several.scene.materials[1].textures[layout::slotBaseColour]);
    EXPECT_TRUE(several.scene.materials[2].textures[layout::slotBaseColour]);
    EXPECT_EQ(several.scene.meshes.at(0).triangleMaterials, (std::vector<std::uint32_t>{2, 1, 0}));
    ASSERT_EQ(several.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(several.meshReports[0].warnings[0].find("lost.png\" is left out: there is no such file"),
              std::string::npos)
        << several.meshReports[0].warnings[0];
}

TEST_F(Ply, PointCloudsAreRefusedAsWhatTheyAre) {
    expectRefusal(textHead + vertexHead + "end_header\n" + square,
                  {"a point cloud, 4 vertices", "reconstruction"});
    expectRefusal(textHead + vertexHead +
                      "element face 0\nproperty list uchar int vertex_indices\nend_header\n",
                  {"a point cloud"});
    expectRefusal(textHead +
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n4 0 1 2 3\n",
                  {"no element \"vertex\""});
}

TEST_F(Ply, HeadersAreRefusedWithTheirLine) {
    expectRefusal("solid\n", {"this is not PLY"});
    expectRefusal("\x1f\x8b\x08pppp", {"it looks like gzip data: unpack it first"});
    expectRefusal("ply\nformat text 1.0\n", {":2: ", "\"text\"", "binary_big_endian"});
    expectRefusal(textHead + "element vertex many\n", {":3: ", "\"many\"", "whole number"});
    expectRefusal(textHead + "element vertex -1\n", {":3: "});
    expectRefusal(textHead + "element vertex 1\nproperty half x\n", {":4: ", "\"half\"", "float"});
    expectRefusal(textHead + "property float x\n", {":3: ", "before the first element"});
    expectRefusal(textHead + vertexHead + "element vertex 1\n", {":7: ", "two elements \"vertex\""});
    expectRefusal(textHead + "element face 1\nproperty list float int vertex_indices\n",
                  {":4: ", "length of a list"});
    expectRefusal(textHead + vertexHead, {":6: ", "no end_header"});
    expectRefusal("ply\nelement vertex 1\nproperty float x\nend_header\n", {":4: ", "no format"});
    expectRefusal(textHead + "element vertex 1\nproperty float x\nproperty float y\n" + faceHead + square,
                  {"lack one of the properties x, y and z"});
    expectRefusal(textHead + vertexHead + "element face 1\nproperty int a\nend_header\n" + square,
                  {"no list vertex_indices"});
}

TEST_F(Ply, BodiesAreRefusedWithTheirPlace) {
    const std::string head = textHead + vertexHead + faceHead;
    expectRefusal(head + "0 0 0\n1 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", {":11: ", "fewer values", "\"vertex\""});
    expectRefusal(head + "0 0 0\n1 0 x\n1 1 0\n0 1 0\n4 0 1 2 3\n", {":11: ", "\"x\""});
    expectRefusal(head + "0 0 0\n1 0 nan\n1 1 0\n0 1 0\n4 0 1 2 3\n", {":11: ", "no finite float"});
    expectRefusal(head + "0 0 0\n1 0 1e999\n1 1 0\n0 1 0\n4 0 1 2 3\n", {":11: ", "no finite float"});
    expectRefusal(head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 4\n",
                  {":14: ", "vertex index 4", "4 vertices"});
    expectRefusal(head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 -1\n", {":14: ", "vertex index -1"});
    expectRefusal(head + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", {"cut short"});
    const std::string binary = "ply\nformat binary_little_endian 1.0\n" + vertexHead + faceHead;
    expectRefusal(binary + std::string(48, '\0') + "\x04" + std::string(15, '\0'),
                  {": byte " + std::to_string(binary.size() + 48) + ": ", "damaged or cut short"});
    expectRefusal(binary + std::string(48, '\0') + "\x03" + std::string(4, '\x10') + std::string(8, '\0'),
                  {": byte " + std::to_string(binary.size() + 48) + ": ", "vertex index"});
}

TEST_F(Ply, CountsThatTheFileCannotHoldAreRefusedAtOnce) {
    expectRefusal("ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\n"
                  "property float y\nproperty float z\n" +
                      faceHead,
                  {"2000000000 rows", "0 bytes are left"});
    expectRefusal(textHead + "element vertex 3000000000\n", {});
    expectRefusal(textHead +
                      "element vertex 3000000000\nproperty float x\nproperty float y\nproperty float z\n" +
                      faceHead + square,
                  {"3000000000 vertices"});
    const ObjMesh loaded =
        read(textHead + vertexHead +
             "element face 99999999999\nproperty list uchar int vertex_indices\nend_header\n" + square);
    expectSquare(loaded);
    EXPECT_EQ(loaded.report.warnings.size(), 1u) << "faces are read as far as they go";
}

TEST_F(Ply, ABareMeshIsOfItsColours) {
    const std::string coloured = textHead +
                                 "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                 "property uchar red\nproperty uchar green\nproperty uchar blue\n" +
                                 faceHead + "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n";
    const Scene scene = loadScene(write("COLOURED.PLY", coloured).string()).scene;
    EXPECT_EQ(scene.materials.at(0).albedo, glm::vec3(1.0f));
    EXPECT_TRUE(scene.materials.at(0).twoSided);
    EXPECT_EQ(loadScene(write("grey.ply", textHead + vertexHead + faceHead + square).string())
                  .scene.materials.at(0)
                  .albedo,
              glm::vec3(0.8f));
}

TEST_F(Ply, ScenesPlaceIt) {
    static_cast<void>(write("square.ply", textHead + vertexHead + faceHead + square));
    const Scene scene = load(R"({"materials": {"m": {"type": "diffuse"}}, "meshes": [
        {"file": "square.ply", "material": "m", "scale": -2, "translate": [0, 0, 5]}]})");
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions.at(2), glm::vec3(-2, -2, 5));
    EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
}

} // namespace
} // namespace hyalite::core
