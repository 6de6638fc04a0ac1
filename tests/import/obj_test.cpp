#include "host/import/obj.h"

#include "host/base/error.h"
#include "tests/fixtures/temporary_folder.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <locale>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

// A file that no other test has, which goes with the object.
struct TemporaryPath {
    const testing::TemporaryFolder folder;
    const std::filesystem::path path = folder.path / "test.obj";
};

ObjMesh loadText(const std::string &text, const MeshTransform &transform = {}) {
    const TemporaryPath file;
    std::ofstream(file.path, std::ios::binary) << text;
    return loadObj(file.path, transform);
}

// The message of the Error that loading throws, from the file's name on; empty where it throws none.
std::string errorOfPath(const std::filesystem::path &path) {
    try {
        (void)loadObj(path);
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::BadInput);
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with(path.string() + ":")) << message;
        return message.substr(std::min(message.size(), path.string().size()));
    }
    return "";
}

std::string errorOf(const std::string &text) {
    const TemporaryPath file;
    std::ofstream(file.path, std::ios::binary) << text;
    return errorOfPath(file.path);
}

void expectError(const std::string &text, const std::string &start, const std::string &part = "") {
    const std::string message = errorOf(text);
    EXPECT_TRUE(message.starts_with(start)) << "input: " << text.substr(0, 200) << "\nmessage: " << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

glm::dvec3 areaVector(const ObjMesh &loaded) {
    glm::dvec3 sum(0.0);
    for (const MeshTriangle &t : loaded.mesh.triangles) {
        const glm::dvec3 a = loaded.mesh.positions[t.positions.x];
        const glm::dvec3 b = loaded.mesh.positions[t.positions.y];
        const glm::dvec3 c = loaded.mesh.positions[t.positions.z];
        sum += 0.5 * glm::cross(b - a, c - a);
    }
    return sum;
}

void expectNear(const glm::vec3 &actual, const glm::dvec3 &expected, double tolerance = 1e-6) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

const std::string threeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string squareVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// ---- Texture coordinates

std::vector<glm::vec2> uvsOf(const ObjMesh &loaded, std::size_t triangle) {
    std::vector<glm::vec2> uvs;
    for (int corner = 0; corner < 3; ++corner)
        uvs.push_back(loaded.mesh.uvs.at(loaded.mesh.triangleUvs.at(triangle)[corner]));
    return uvs;
}

TEST(Obj, TexturesCoordinatesGoWithTheirCorners) {
    const std::string uvs = "vt 0 0\nvt 1 0 7\nvt 1 0.5\nvt 0.25\n";
    // Polygons are cut, and each part keeps what its corners have; the second line takes the longer way through the
    // reader.
    for (const std::string face : {"f 1/1 2/2 3/3 4/4\n", " f 1/-4 2/-3 3/-2 4/-1 # a comment\n"}) {
        const ObjMesh loaded = loadText(squareVertices + uvs + face);
        ASSERT_EQ(loaded.mesh.triangleUvs.size(), 2u);
        EXPECT_EQ(uvsOf(loaded, 0), (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 0.5f}})) << face;
        EXPECT_EQ(uvsOf(loaded, 1), (std::vector<glm::vec2>{{0, 0}, {1, 0.5f}, {0.25f, 0}})) << face;
    }
    // Faces may come before them, and a mesh that is turned inside out has its corners in another order.
    MeshTransform mirror;
    mirror.scale = -1.0;
    const ObjMesh turned = loadText("f 1/1 2/2 3/3\n" + threeVertices + uvs, mirror);
    EXPECT_EQ(turned.mesh.triangles.at(0).positions, glm::uvec3(0, 2, 1));
    EXPECT_EQ(uvsOf(turned, 0), (std::vector<glm::vec2>{{0, 0}, {1, 0.5f}, {1, 0}}));
}

TEST(Obj, TextureCoordinatesThatAreNotThereAreNone) {
    const std::string uvs = "vt 0 0\nvt 1 0\nvt 0 1\n";
    EXPECT_TRUE(loadText(threeVertices + uvs + "f 1 2 3\n").mesh.triangleUvs.empty());
    EXPECT_TRUE(loadText(threeVertices + "f 1/1 2/2 3/3\n").mesh.triangleUvs.empty())
        << "the file has lost them";
    EXPECT_TRUE(loadText(threeVertices + uvs + "f 1/1 2/2 3\n").mesh.triangleUvs.empty());
    EXPECT_TRUE(loadText(threeVertices + uvs + "f 1/-9 2/2 3/3\n").mesh.triangleUvs.empty());
    const ObjMesh partly = loadText(threeVertices + uvs + "f 1 2 3\nf 1/1 2/2 3/3\nf 1/0 2/0 3/0\n");
    EXPECT_EQ(
        partly.mesh.triangleUvs,
        (std::vector<glm::uvec3>{glm::uvec3(TriangleMesh::noUv), {0, 1, 2}, glm::uvec3(TriangleMesh::noUv)}));
    EXPECT_EQ(partly.report.uvLessCount, 2u);
    const ObjMesh odd = loadText(threeVertices + "vt nan 1\nvt 1e300 0.5\nvt 1 -inf\nf 1/1 2/2 3/3\n");
    EXPECT_EQ(uvsOf(odd, 0), (std::vector<glm::vec2>{{0, 0}, {0, 0.5f}, {0, 0}}));
    expectError(threeVertices + "vt x 1\nf 1 2 3\n", ":4: vt has \"x\"");
    expectError(threeVertices + " vt\nf 1 2 3\n", ":4: vt has no number");
}

TEST(Obj, ReadsEveryFaceSyntax) {
    const std::string data = threeVertices + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nvn 0 0 2\nvn 0 0 3\n";
    for (const std::string face : {"1 2 3", "1/1 2/2 3/3", "1/ 2/ 3/", "1// 2// 3//", "1/3/ 2/2/ 3/1/"}) {
        const ObjMesh loaded = loadText(data + "f " + face + "\n");
        ASSERT_EQ(loaded.mesh.triangles.size(), 1u) << face;
        EXPECT_EQ(loaded.mesh.triangles[0].positions, glm::uvec3(0, 1, 2)) << face;
        EXPECT_EQ(loaded.mesh.triangles[0].normals, glm::uvec3(MeshTriangle::noNormal)) << face;
        EXPECT_EQ(loaded.report.lostNormalCount, 0u) << face;
    }
    for (const std::string face : {"1//3 2//2 3//1", "1/1/3 2/1/2 3/1/1", "+1//+3 02//0002 3/-1/1"}) {
        const ObjMesh loaded = loadText(data + "f " + face + "\n");
        ASSERT_EQ(loaded.mesh.triangles.size(), 1u) << face;
        EXPECT_EQ(loaded.mesh.triangles[0].positions, glm::uvec3(0, 1, 2)) << face;
        EXPECT_EQ(loaded.mesh.triangles[0].normals, glm::uvec3(2, 1, 0)) << face;
        for (const glm::vec3 &normal : loaded.mesh.normals)
            EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    }
}

TEST(Obj, NegativeIndicesCountBackFromTheFace) {
    const ObjMesh loaded = loadText(threeVertices + "vn 0 0 1\nf -3//-1 -2//-1 -1//-1\n" +
                                    "v 5 5 5\nv 6 5 5\nv 5 6 5\nvn 0 0 1\nf -3//-1 -2//-2 -1//-1\n");
    ASSERT_EQ(loaded.mesh.triangles.size(), 2u);
    EXPECT_EQ(loaded.mesh.triangles[0].positions, glm::uvec3(0, 1, 2));
    EXPECT_EQ(loaded.mesh.triangles[0].normals, glm::uvec3(0, 0, 0));
    EXPECT_EQ(loaded.mesh.triangles[1].positions, glm::uvec3(3, 4, 5));
    EXPECT_EQ(loaded.mesh.triangles[1].normals, glm::uvec3(1, 0, 1));
}

TEST(Obj, VerticesMayFollowTheFacesThatUseThem) {
    const ObjMesh loaded = loadText("f 1//1 2//1 3//1\n" + threeVertices + "vn 0 0 1\n");
    EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
}

TEST(Obj, ConcavePolygonsKeepAreaAndOrientation) {
    const std::string data = "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n";
    const ObjMesh loaded = loadText(data + "f 4 5 6 1 2 3\n");
    EXPECT_EQ(loaded.mesh.triangles.size(), 4u);
    EXPECT_EQ(areaVector(loaded), glm::dvec3(0, 0, 5));
    EXPECT_EQ(loaded.report.faceCount, 1u);
    EXPECT_EQ(loaded.report.polygonCount, 1u);
    EXPECT_EQ(areaVector(loadText(data + "f 6 5 4 3 2 1\n")), glm::dvec3(0, 0, -5));
}

TEST(Obj, ReadsPolygonsOfManyCorners) {
    for (const int count : {300, 20'000}) {
        std::ostringstream text;
        std::string face = "f";
        for (int i = 0; i < count; ++i) {
            const double radius = i % 2 ? 1.0 : 0.5;
            const double angle = 2.0 * std::numbers::pi * i / count;
            text << "v " << radius * std::cos(angle) << " 0 " << radius * std::sin(angle) << "\n";
            face += " " + std::to_string(i + 1);
        }
        const ObjMesh loaded = loadText(text.str() + face);
        EXPECT_EQ(loaded.mesh.triangles.size(), static_cast<std::size_t>(count) - 2);
        const double area = 0.5 * count * 0.5 * std::sin(2.0 * std::numbers::pi / count);
        EXPECT_NEAR(areaVector(loaded).y, -area, 1e-3 * area); // six digits in the text
    }
}

TEST(Obj, LineEndsAndContinuationsMakeNoDifference) {
    const std::string unixText = squareVertices + "# comment\n\n\t \nf 1 2 3 4\n";
    const ObjMesh expected = loadText(unixText);
    const auto expectSame = [&](const std::string &text, const char *what) {
        SCOPED_TRACE(what);
        const ObjMesh loaded = loadText(text);
        EXPECT_EQ(loaded.mesh.positions, expected.mesh.positions);
        ASSERT_EQ(loaded.mesh.triangles.size(), 2u);
        EXPECT_EQ(loaded.mesh.triangles[1].positions, expected.mesh.triangles[1].positions);
        EXPECT_EQ(loaded.report.unusedStatementCount, 0u);
    };
    const auto withLineEnd = [&](const std::string &lineEnd) {
        std::string text;
        for (const char c : unixText)
            text += c == '\n' ? lineEnd : std::string(1, c);
        return text;
    };
    expectSame(withLineEnd("\r\n"), "CRLF");
    expectSame(withLineEnd("\r"), "CR");
    expectSame(withLineEnd(" \t\n"), "trailing blanks");
    expectSame("\xEF\xBB\xBF" + unixText, "byte order mark");
    expectSame(unixText.substr(0, unixText.size() - 1), "no line end at the end");
    expectSame("  v\t0  0\t0\nv 1 0 0 1.0\nv 1 1 0 # here\nv 0 1 0 0.5 0.5 0.5\n\tf  1\t2 3  4 #5\n", "tabs");
    expectSame(squareVertices + "f 1 \\\n2 \\\n\\\n 3 4\n", "backslash");
    expectSame(squareVertices + "f 1 \\\r\n2 3\\\r\n 4\\", "backslash and CRLF");
    expectSame("# C:\\meshes\\\n" + unixText, "backslash in a comment");
}

// Random vertices, normals and faces in every plain form, some 800 kB: longer than any buffer.
std::vector<std::string> randomStatements() {
    std::mt19937 random(7);
    std::vector<std::string> lines;
    const char *const formats[] = {"%.5f", "%.6f", "%g",    "%.9g",  "%.17g",
                                   "%.0f", "%e",   "%.12f", "%.20f", "%.1e"};
    const auto numbers = [&](double size) {
        std::string text;
        for (int i = 0; i < 3; ++i) {
            char number[64];
            std::snprintf(number, sizeof number, formats[random() % std::size(formats)],
                          size * (static_cast<double>(random()) / 2147483648.0 - 1.0));
            text += std::string(1, " \t"[random() % 2]) + number;
        }
        return text;
    };
    for (int i = 1; i <= 5000; ++i) {
        lines.push_back("v" + numbers(std::pow(10.0, static_cast<int>(random() % 20) - 6)));
        lines.push_back("vn" + numbers(1.0));
        lines.push_back("vt" + numbers(1.0));
        std::string face = "f";
        const int form = static_cast<int>(random() % 4);
        for (std::size_t corner = 0, count = 3 + random() % 7; corner < count; ++corner) {
            const auto index = [&] {
                const int fromStart = static_cast<int>(random() % static_cast<unsigned>(i)) + 1;
                return std::to_string(random() % 2 == 0 ? fromStart : fromStart - i - 1);
            };
            face += " " + index();
            face += form == 1 ? "/" + index() : form == 2 ? "//" + index() : "";
            face += form == 3 ? "/" + index() + "/" + index() : "";
        }
        lines.push_back(face);
    }
    return lines;
}

TEST(Obj, ThePlainestStatementsReadAsAllOthers) {
    const std::vector<std::string> lines = randomStatements();
    const auto load = [&](const std::string &before, const std::string &after) {
        std::string text;
        for (const std::string &line : lines)
            text += before + line + after;
        return loadText(text);
    };
    const ObjMesh expected = load(" ", "\n"); // an indent is enough not to be plain
    EXPECT_GT(expected.mesh.triangles.size(), 10'000u);
    for (const std::string lineEnd : {"\n", "\r\n", " \n", "\t \r\n"}) {
        const ObjMesh loaded = load("", lineEnd);
        EXPECT_EQ(loaded.mesh.positions, expected.mesh.positions);
        EXPECT_EQ(loaded.mesh.normals, expected.mesh.normals);
        ASSERT_EQ(loaded.mesh.triangles.size(), expected.mesh.triangles.size());
        for (std::size_t i = 0; i < loaded.mesh.triangles.size(); ++i) {
            EXPECT_EQ(loaded.mesh.triangles[i].positions, expected.mesh.triangles[i].positions);
            EXPECT_EQ(loaded.mesh.triangles[i].normals, expected.mesh.triangles[i].normals);
        }
        EXPECT_EQ(loaded.report.faceCount, expected.report.faceCount);
        EXPECT_EQ(loaded.report.polygonCount, expected.report.polygonCount);
        EXPECT_EQ(loaded.report.degenerateTriangleCount, expected.report.degenerateTriangleCount);
        EXPECT_EQ(loaded.report.lostNormalCount, expected.report.lostNormalCount);
    }
}

TEST(Obj, AFaceThatNamesAVertexTooEarlyKeepsItsPlace) {
    const ObjMesh loaded =
        loadText("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 2 3 1\nv 0 0 1\nf 4 3 2\n");
    ASSERT_EQ(loaded.mesh.triangles.size(), 4u);
    EXPECT_EQ(loaded.mesh.triangles[0].positions, glm::uvec3(0, 1, 2));
    EXPECT_EQ(loaded.mesh.triangles[1].positions, glm::uvec3(0, 1, 3));
    EXPECT_EQ(loaded.mesh.triangles[2].positions, glm::uvec3(1, 2, 0));
    EXPECT_EQ(loaded.mesh.triangles[3].positions, glm::uvec3(3, 2, 1));
    expectError(threeVertices + "f 1 2 5\nf 1 2 9\nv 0 0 1\n", ":4: the face has the vertex index 5",
                "the file has 4");
}

TEST(Obj, LinesMayBeLongerThanTheBuffer) {
    const std::string padding(1'000'000, ' ');
    const ObjMesh loaded =
        loadText(threeVertices + "f 1" + padding + "2" + padding + "3\r\n#" + padding + "\nx");
    EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
    EXPECT_EQ(loaded.report.unusedStatementCount, 1u);
    expectError(std::string(17'000'000, ' '), ":1: the line is too long", "16777216");
}

TEST(Obj, GroupsMaterialsAndMissingMaterialFilesAreIgnored) {
    const ObjMesh loaded =
        loadText("mtllib missing.mtl\no thing\n" + threeVertices + "vt 0 0\ng a b\nusemtl red\ns off\n" +
                 "f 1 2 3\ng\nusemtl\nf 3 2 1\nl 1 2\np 1\ncurv 0 1\nunknown\nvp 1 2\n");
    EXPECT_EQ(loaded.mesh.triangles.size(), 2u);
    EXPECT_EQ(loaded.report.faceCount, 2u);
    EXPECT_EQ(loaded.report.polygonCount, 0u);
    EXPECT_EQ(loaded.report.unusedStatementCount, 5u);
}

TEST(Obj, NormalsThatTheFileDoesNotHaveGiveWayToTheGeometricOne) {
    const ObjMesh loaded =
        loadText("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//1 2//9 3//1\n"
                 "f 1//-5 2//1 3//1\n");
    ASSERT_EQ(loaded.mesh.triangles.size(), 3u);
    EXPECT_EQ(loaded.mesh.triangles[0].normals, glm::uvec3(0));
    EXPECT_EQ(loaded.mesh.triangles[1].normals, glm::uvec3(MeshTriangle::noNormal));
    EXPECT_EQ(loaded.mesh.triangles[2].normals, glm::uvec3(MeshTriangle::noNormal));
    EXPECT_EQ(loaded.report.undefinedNormalCount, 2u);
    EXPECT_EQ(loaded.report.lostNormalCount, 2u);
    ASSERT_EQ(loaded.report.warnings.size(), 1u) << "once";
    EXPECT_NE(loaded.report.warnings[0].find("2 triangles name normals that the file does not have"),
              std::string::npos)
        << loaded.report.warnings[0];
}

TEST(Obj, KeywordsMayBeInCapitals) {
    const ObjMesh loaded = loadText("V 0 0 0\nV 1 0 0\n\tV 0 1 0\nVN 0 0 1\nVT 0 0\nF 1/1/1 2/1/1 3/1/1\n");
    EXPECT_EQ(loaded.mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(loaded.mesh.normals, std::vector<glm::vec3>{glm::vec3(0, 0, 1)});
    EXPECT_TRUE(loaded.report.warnings.empty());
}

TEST(Obj, HasTheColoursOfItsVertices) {
    // The second vertex is read by tinyobjloader, as it is indented.
    const ObjMesh loaded =
        loadText("v 0 0 0 1 0.5 0\n v 1 0 0 0.25 2 -1\nv 0 1 0 7 1 1 0.5\nv 0 0 1\nv 0 0 2 1\n"
                 "f 1 2 3\nf 1 2 4 5\n");
    const CornerValues<glm::vec4> &colours = loaded.mesh.colours;
    ASSERT_EQ(colours.values.size(), 5u);
    ASSERT_EQ(colours.corners.size(), loaded.mesh.triangles.size());
    for (std::size_t i = 0; i < colours.corners.size(); ++i)
        EXPECT_EQ(colours.corners[i], loaded.mesh.triangles[i].positions);
    EXPECT_EQ(colours.values[0].x, 1.0f);
    EXPECT_NEAR(colours.values[0].y, 0.21404f, 1e-5f) << "0.5 of sRGB, as light";
    EXPECT_NEAR(colours.values[1].x, 0.05088f, 1e-5f);
    EXPECT_EQ(colours.values[1].y, 1.0f);
    EXPECT_EQ(colours.values[1].z, 0.0f);
    EXPECT_EQ(colours.values[2].x, 1.0f) << "behind the weight";
    EXPECT_EQ(colours.values[3], glm::vec4(1.0f)) << "white, as it has none";
    EXPECT_EQ(colours.values[4], glm::vec4(1.0f)) << "a weight is no colour";
    EXPECT_TRUE(loadText(threeVertices + "f 1 2 3\n").mesh.colours.corners.empty());
}

TEST(Obj, ErrorsNameTheLineWhatWasFoundAndWhatIsAllowed) {
    expectError("\n# c\nv 1 2\n", ":3: v has fewer than three numbers");
    expectError("v\n", ":1: v has fewer than three numbers");
    expectError("vn 1 #2 3\n", ":1: vn has fewer than three numbers");
    expectError("v 1 2 x\n", ":1: v has \"x\"", "finite decimal numbers");
    expectError("vn 1 2 3x\n", ":1: vn has \"3x\"", "finite decimal numbers");
    expectError(threeVertices + "f 1 2 0\n", ":4: the face's corner \"0\"", "not 0");
    expectError(threeVertices + "f 1 2 3//0\n", ":4: the face's corner \"3//0\"");
    expectError(threeVertices + "f 1 2 4\n", ":4: the face has the vertex index 4", "the file has 3");
    expectError(threeVertices + "f 1 2 -4\n", ":4: the face has the vertex index -4", "3 are defined");
    expectError(threeVertices + "f 1 \\\n2 \\\n4\n", ":4: the face has the vertex index 4");
    expectError("v 0 0 0\\\r\n\r\nv 1\r\n", ":3: v has fewer");
    for (const std::string corner :
         {"a", "1a", "1/a", "1//a", "1/1/a", "/1", "1///", "1/1/1/1", "1.0", "-", "1-2"})
        expectError(threeVertices + "f 1 2 " + corner + "\n", ":4: the face's corner \"" + corner + "\"");
    std::string manyCorners = "f";
    for (int i = 0; i < 65'537; ++i)
        manyCorners += " 1";
    expectError(threeVertices + manyCorners, ":4: the face has 65537 corners", "65536");
}

TEST(Obj, WhatIsLeftOutIsOneWarningAKind) {
    const ObjMesh loaded =
        loadText(threeVertices + "f 1 2 3\nf 1 2\nf\nf 2\nl 1 2 3\n l 1 2\np 1\nusemap x\ncurv 0 1\n"
                                 "s 1\nlod 2\n");
    EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
    EXPECT_EQ(loaded.report.unusedStatementCount, 8u);
    const char *const parts[] = {":5: a face with fewer than three corners is left out (and 2 more)",
                                 ":8: a line is left out: surfaces are rendered (and 1 more)",
                                 ":10: points are left out",
                                 ":11: \"usemap\" is left out: it is no statement that is read (and 1 more)"};
    ASSERT_EQ(loaded.report.warnings.size(), std::size(parts))
        << ::testing::PrintToString(loaded.report.warnings);
    for (std::size_t i = 0; i < std::size(parts); ++i)
        EXPECT_NE(loaded.report.warnings[i].find(parts[i]), std::string::npos) << loaded.report.warnings[i];
}

TEST(Obj, VerticesThatNoFaceUsesMayHaveNoPlace) {
    const ObjMesh plain = loadText(threeVertices + "f 1 2 3\n");
    for (const std::string number : {"nan", "NaN", "-nan", "inf", "-Infinity", "1.#INF", "1e39", "1e20"})
        for (const char *indent : {"", " "}) {
            const std::string lost = std::string(indent) + "v 0 " + number + " 0\n";
            const ObjMesh loaded = loadText(threeVertices + lost + "f 1 2 3\n" + lost);
            EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
            EXPECT_EQ(loaded.mesh.positions.size(), 5u);
            EXPECT_EQ(loaded.mesh.positions[4], plain.mesh.positions[0]) << "where the mesh is";
            ASSERT_EQ(loaded.report.warnings.size(), 1u);
            EXPECT_NE(loaded.report.warnings[0].find(": 2 vertices that no face uses have no finite place"),
                      std::string::npos)
                << loaded.report.warnings[0];
            expectError(threeVertices + lost + "f 1 2 3\nf 1 2 4\n",
                        ":4: ", number == "1e20" ? "1e15" : "no finite float");
            expectError("f 1 2 4\n" + threeVertices + lost, ":5: ");
        }
}

TEST(Obj, MessagesShowNothingUnprintableAndStayShort) {
    expectError("v 1 2 \x1b[31m\x80\n", ":1: v has \"\uFFFD[31m\uFFFD\"");
    expectError(std::string("v 1 2 3\0", 8), ":1: v has \"3\uFFFD\"");
    const std::string message = errorOf("v 1 2 " + std::string(100'000, '3'));
    EXPECT_LT(message.size(), 300u);
}

TEST(Obj, IndicesBeyond32BitsAreErrors) {
    for (const std::string index : {"2147483648", "-2147483649", "4294967297", "-4294967295",
                                    "18446744073709551617", "99999999999999999999999999"}) {
        expectError(threeVertices + "f 1 2 " + index + "\n", ":4: the face's corner \"" + index + "\"");
        expectError(threeVertices + "f 1 2 3/" + index + "\n", ":4: the face's corner");
        expectError(threeVertices + "f 1 2 3//" + index + "\n", ":4: the face's corner");
    }
    expectError(threeVertices + "f 1 2 2147483647\n", ":4: the face has the vertex index 2147483647");
    expectError(threeVertices + "f 1 2 -2147483648\n", ":4: the face has the vertex index -2147483648");
}

TEST(Obj, NumbersAreReadAsTheDecimalsThatTheyAre) {
    const ObjMesh loaded = loadText("v 1.5e-3 -.5 +2.\nv 0.1000000000000000055511151231257827 1E2 00012.50\n"
                                    "v 1e-45 1e-300 0e0\nv 123456789 -1e+14 1e-999\nf 1 2 4\n");
    EXPECT_EQ(loaded.mesh.positions[0], glm::vec3(1.5e-3f, -0.5f, 2.0f));
    EXPECT_EQ(loaded.mesh.positions[1], glm::vec3(0.1f, 100.0f, 12.5f));
    EXPECT_EQ(loaded.mesh.positions[2], glm::vec3(1e-45f, 0.0f, 0.0f));
    EXPECT_EQ(loaded.mesh.positions[3], glm::vec3(123456789.0f, -1e14f, 0.0f));
}

TEST(Obj, NumbersThatAreNoFiniteFloatsAreErrors) {
    for (const std::string number : {"1e99999999999", "1e-99999999999", "1e2147483649", "0x10", "1,5", "1e",
                                     "1e+", ".", "-", "+-1", "--1", "1.2.3", "e5", "1f", "1e1e1"})
        expectError("v 0 0 0\nv 0 " + number + " 0\n", ":2: v has \"" + number + "\"");
    expectError("v 0 " + std::string(129, '1') + " 0\n", ":1: v has \"1111", "128 characters");
    for (const std::string number : {"1e39", "-1e39", "1e308", "1e309", "1e999", "3.5e38"})
        expectError("v 0 0 " + number + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ":1: vertex (",
                    "is no finite float");
    expectError("v 0 1e38 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                ":1: the vertex is at (0, 1e+38, 0) after the transform", "1e15");
}

TEST(Obj, ACommaLocaleHasNoEffect) {
    struct CommaPunctuation : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaPunctuation));
    for (const char *name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"}) // where it is installed
        if (std::setlocale(LC_ALL, name))
            break;
    const ObjMesh loaded = loadText("v 0.5 1234.25 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
    const std::string message = errorOf("v 1,5 0 0\n");
    const std::string decimals = errorOf("v 1.5e39 0.25 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::setlocale(LC_ALL, "C");
    std::locale::global(before);
    EXPECT_EQ(loaded.mesh.positions[0], glm::vec3(0.5f, 1234.25f, 0.0f));
    EXPECT_TRUE(message.starts_with(":1: v has \"1,5\"")) << message;
    EXPECT_TRUE(decimals.starts_with(":1: vertex (1.5e+39, 0.25, 0)")) << decimals;
}

TEST(Obj, FilesWithoutATriangleAreErrors) {
    expectError("", ": no triangle in 0 faces");
    expectError("\xEF\xBB\xBF", ": no triangle in 0 faces");
    expectError("# nothing\n", ": no triangle in 0 faces");
    expectError(threeVertices, ": no triangle in 0 faces", "needed: points and lines alone are no surface");
    expectError(threeVertices + "p 1 2\nl 2 3\n", ": no triangle in 0 faces", "points and lines alone");
    expectError(threeVertices + "f 1 1 2\nf 1 2 1\n", ": no triangle in 2 faces (2 dropped");
}

TEST(Obj, OnlyRegularFilesAreOpened) {
    const TemporaryPath temporary;
    EXPECT_NE(errorOfPath(temporary.path), "");
    ASSERT_EQ(::mkfifo(temporary.path.c_str(), 0600), 0);
    EXPECT_NE(errorOfPath(temporary.path).find("not a regular file"), std::string::npos);
    EXPECT_NE(errorOfPath(temporary.path.parent_path()).find("not a regular file"), std::string::npos);
    EXPECT_NE(errorOfPath("/dev/zero").find("not a regular file"), std::string::npos);
    EXPECT_NE(errorOfPath(temporary.path / "below"), "");
}

TEST(Obj, ScalesThenRotatesAboutXThenYThenZThenTranslates) {
    const std::string text = "v 1 2 3\nv 0 0 0\nv 1 0 0\nvn 1 2 3\nf 1 2 3\n";
    // (1 2 3) * 2 = (2 4 6); about x: (2 -6 4); about y: (4 -6 -2); about z: (6 4 -2)
    const MeshTransform quarterTurns{2.0, {90.0, 90.0, 90.0}, {10.0, 20.0, 30.0}};
    EXPECT_EQ(loadText(text, quarterTurns).mesh.positions[0], glm::vec3(16, 24, 28));

    const MeshTransform transform{0.5, {10.0, -20.0, 130.0}, {-1.0, 0.5, 7.0}};
    glm::dvec3 p(1.0, 2.0, 3.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double angle = transform.rotateDegrees[axis] * std::numbers::pi / 180.0;
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const glm::dvec3 q = p;
        p[u] = std::cos(angle) * q[u] - std::sin(angle) * q[v];
        p[v] = std::sin(angle) * q[u] + std::cos(angle) * q[v];
    }
    const ObjMesh loaded = loadText(text, transform);
    expectNear(loaded.mesh.positions[0], 0.5 * p + transform.translate);
    expectNear(loaded.mesh.normals[0], glm::normalize(p));
    EXPECT_EQ(loaded.mesh.positions[1], glm::vec3(transform.translate));
}

TEST(Obj, TheIdentityAndWholeTurnsKeepEveryBit) {
    const std::string text = "v 0.1 -0.7 1234.567\nv 1e-30 3 4\nv 1 2 9\nf 1 2 3\n";
    const glm::vec3 expected(0.1f, -0.7f, 1234.567f);
    EXPECT_EQ(loadText(text).mesh.positions[0], expected);
    EXPECT_EQ(loadText(text, {1.0, {360.0, -720.0, 0.0}, {}}).mesh.positions[0], expected);
    EXPECT_EQ(loadText(text, {1.0, {180.0, 180.0, 180.0}, {}}).mesh.positions[0], expected);
}

TEST(Obj, CoordinatesAreRoundedOnceAfterTheTransform) {
    const ObjMesh loaded =
        loadText("v 100000.01 0 0\nv 100001 0 0\nv 100000 1 0\nf 1 2 3\n", {1.0, {}, {-100000.0, 0.0, 0.0}});
    EXPECT_NEAR(loaded.mesh.positions[0].x, 0.01, 1e-9);
}

TEST(Obj, ANegativeScaleKeepsTheOutsideOutside) {
    // a tetrahedron, outward-wound, with the normal of each face
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 -1\nvn 0 -1 0\nvn -1 0 0\nvn 1 1 1\n"
                             "f 1//1 3//1 2//1\nf 1//2 2//2 4//2\nf 1//3 4//3 3//3\nf 2//4 3//4 4//4\n";
    for (const double scale : {1.0, -1.0, -3.0, 0.25}) {
        SCOPED_TRACE(scale);
        const ObjMesh loaded = loadText(text, {scale, {20.0, 30.0, 40.0}, {1.0, 2.0, 3.0}});
        double volume = 0.0;
        for (const MeshTriangle &t : loaded.mesh.triangles) {
            const glm::dvec3 a = loaded.mesh.positions[t.positions.x];
            const glm::dvec3 b = loaded.mesh.positions[t.positions.y];
            const glm::dvec3 c = loaded.mesh.positions[t.positions.z];
            volume += glm::dot(a, glm::cross(b, c)) / 6.0;
            const glm::dvec3 geometric = glm::normalize(glm::cross(b - a, c - a));
            expectNear(loaded.mesh.normals[t.normals.x], geometric);
            EXPECT_EQ(t.normals.x, t.normals.y);
        }
        EXPECT_NEAR(volume, std::abs(scale * scale * scale) / 6.0, 1e-5 * std::abs(scale * scale * scale));
    }
}

TEST(Obj, EachCornerKeepsItsNormalWhenTheWindingTurns) {
    const ObjMesh loaded =
        loadText(threeVertices + "vn 1 0 0\nvn 0 1 0\nvn 0 0 1\nf 1//1 2//2 3//3\n", {-1.0, {}, {}});
    EXPECT_EQ(loaded.mesh.triangles[0].positions, loaded.mesh.triangles[0].normals);
}

TEST(Obj, DegenerateTrianglesAreDroppedAndCounted) {
    const ObjMesh loaded = loadText(threeVertices + "v 2 0 0\nv 0 0 0\n" +
                                    "f 1 2 3\n"   // kept
                                    "f 1 1 3\n"   // a vertex twice
                                    "f 1 5 3\n"   // a position twice
                                    "f 1 2 4\n"   // on a line
                                    "f 2 4 1 5\n" // a folded line: two
    );
    EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
    EXPECT_EQ(loaded.report.degenerateTriangleCount, 5u);
    EXPECT_EQ(loaded.report.faceCount, 5u);
}

TEST(Obj, TinyTrianglesAreNotDegenerate) {
    const ObjMesh loaded = loadText("v 0 0 0\nv 1e-40 0 0\nv 0 1e-40 0\nf 1 2 3\n");
    EXPECT_EQ(loaded.mesh.triangles.size(), 1u);
}

TEST(Obj, UnusableNormalsFallBackToTheGeometricNormal) {
    for (const std::string normal : {"0 0 0", "-0 0 0.0", "nan 0 1", "0 -inf 1", "0 1 NAN", "-nan(ind) 0 0",
                                     "1.#QNAN 1 1", "1e400 0 0", "Infinity Infinity Infinity"}) {
        const ObjMesh loaded = loadText(threeVertices + "vn 0 0 1\nvn " + normal +
                                        "\nf 1//1 2//1 3//2\nf 1//1 2//1 3//1\nf 1//2 2//2 3//2\n");
        EXPECT_EQ(loaded.report.lostNormalCount, 2u) << normal;
        EXPECT_EQ(loaded.mesh.triangles[0].normals, glm::uvec3(MeshTriangle::noNormal)) << normal;
        EXPECT_EQ(loaded.mesh.triangles[1].normals, glm::uvec3(0)) << normal;
        for (const glm::vec3 &stored : loaded.mesh.normals)
            EXPECT_NEAR(glm::length(stored), 1.0f, 1e-6f) << normal;
    }
}

TEST(Obj, AFaceWithNormalsAtSomeCornersUsesTheGeometricNormal) {
    const ObjMesh loaded = loadText(squareVertices + "vn 0 0 1\nf 1//1 2//1 3//1 4\n");
    ASSERT_EQ(loaded.mesh.triangles.size(), 2u);
    for (const MeshTriangle &triangle : loaded.mesh.triangles)
        EXPECT_EQ(triangle.normals, glm::uvec3(MeshTriangle::noNormal));
    EXPECT_EQ(loaded.report.lostNormalCount, 2u);
}

TEST(Obj, NormalsOfAnyLengthAreNormalised) {
    const ObjMesh loaded = loadText(
        threeVertices + "vn 1e300 1e300 0\nvn 1e-300 0 0\nvn 3 0 4\nf 1//1 2//2 3//3\n", {1e-30, {}, {}});
    expectNear(loaded.mesh.normals[0], glm::dvec3(std::sqrt(0.5), std::sqrt(0.5), 0.0));
    expectNear(loaded.mesh.normals[1], glm::dvec3(1.0, 0.0, 0.0));
    expectNear(loaded.mesh.normals[2], glm::dvec3(0.6, 0.0, 0.8));
    EXPECT_EQ(loaded.report.lostNormalCount, 0u);
}

TEST(Obj, TheMeshIsNamedAfterItsFile) {
    const TemporaryPath file;
    std::ofstream(file.path) << threeVertices << "f 1 2 3\n";
    const ObjMesh loaded = loadObj(file.path);
    EXPECT_EQ(loaded.mesh.name, file.path.string());
    EXPECT_EQ(loaded.mesh.materialIndex, 0u);
}

} // namespace
} // namespace hyalite::core
