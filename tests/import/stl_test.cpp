// STL meshes: text and binary, and how one is told from the other.
#include "host/import/stl.h"

#include "host/import/load.h"
#include "tests/fixtures/scene_json_fixture.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

using Triangle = std::array<std::array<float, 3>, 3>;
const std::vector<Triangle> square{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}},
                                   {{{0, 0, -0.0f}, {1, 1, 0}, {0, 1, 0}}}};

std::string binaryStl(const std::string &title, const std::vector<Triangle> &triangles) {
    const auto raw = [](const auto &value) {
        std::string bytes(sizeof value, '\0');
        std::memcpy(bytes.data(), &value, sizeof value);
        return bytes;
    };
    std::string text = title;
    text.resize(80, ' ');
    text += raw(static_cast<std::uint32_t>(triangles.size()));
    for (const Triangle &triangle : triangles)
        text += std::string(12, '\0') + raw(triangle) + std::string(2, '\0');
    return text;
}

const std::string textStl = "solid a name of words\n"
                            "facet normal 0 0 -1\n  outer loop\n    vertex 0 0 0\n    vertex 1 0 0\n"
                            "    vertex 1 1 0\n  endloop\nendfacet\n"
                            "facet normal nan 0 0\n  outer loop\n    vertex 0 0 -0\n    vertex 1.0e0 1 0\n"
                            "    vertex 0 +1 0\n  endloop\nendfacet\nendsolid a name of words\n";

class Stl : public SceneFolder {
  protected:
    [[nodiscard]] ObjMesh read(const std::string &text) const { return loadStl(write("mesh.stl", text)); }

    void expectRefusal(const std::string &text, const std::vector<std::string> &parts) const {
        const std::filesystem::path file = write("mesh.stl", text);
        try {
            static_cast<void>(loadStl(file));
            ADD_FAILURE() << "not refused";
        } catch (const Error &error) {
            EXPECT_EQ(error.kind, ErrorKind::BadInput);
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with(file.string() + ":")) << message;
            for (const std::string &part : parts)
                EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
        }
    }
};

void expectSquare(const ObjMesh &loaded) {
    EXPECT_EQ(loaded.mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}))
        << "vertices of several triangles are one";
    ASSERT_EQ(loaded.mesh.triangles.size(), 2u);
    EXPECT_EQ(loaded.mesh.triangles[0].positions, glm::uvec3(0, 1, 2));
    EXPECT_EQ(loaded.mesh.triangles[1].positions, glm::uvec3(0, 2, 3));
    EXPECT_EQ(loaded.mesh.triangles[0].normals, glm::uvec3(MeshTriangle::noNormal)) << "of the winding";
}

TEST_F(Stl, TextMayBePadded) {
    for (const std::string &padding :
         {std::string("\0\0\0", 3), std::string("\x1A"), std::string("\r\n\x1A\0 \n", 6)}) {
        const ObjMesh loaded = read(textStl + padding);
        expectSquare(loaded);
        EXPECT_TRUE(loaded.report.warnings.empty());
    }
}

TEST_F(Stl, TextThatEndsTooEarlyIsReadAsFarAsItGoes) {
    const std::size_t second = textStl.find("facet normal nan");
    const std::size_t behindFirst = textStl.find("endfacet");
    for (std::size_t size = behindFirst + 1; size < textStl.rfind("endloop"); ++size) {
        const ObjMesh loaded = read(textStl.substr(0, size));
        EXPECT_EQ(loaded.mesh.triangles.size(), 1u) << size;
        const bool isWithinFacet = size > textStl.find("vertex", second);
        EXPECT_TRUE(!isWithinFacet || loaded.report.warnings.size() == 1) << textStl.substr(0, size);
    }
}

TEST_F(Stl, TheColourOfAHeaderIsTold) {
    const ObjMesh loaded = read(binaryStl("COLOR=\xFF\x01\x01\xFF", square));
    expectSquare(loaded);
    ASSERT_EQ(loaded.report.warnings.size(), 1u);
    EXPECT_NE(loaded.report.warnings[0].find("the colour of its header"), std::string::npos);
}

TEST_F(Stl, IsReadAsText) {
    expectSquare(read(textStl));
    std::string shouting;
    for (const char c : textStl)
        shouting += c == '\n'
                        ? std::string("\r\n")
                        : std::string(1, static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
    expectSquare(read(shouting));
}

TEST_F(Stl, IsReadAsBytes) {
    expectSquare(read(binaryStl("of some program", square)));
    expectSquare(read(binaryStl("COLOR=", square) + "and more behind the last triangle"));
}

TEST_F(Stl, MayBeginWithSolidAndBeBinary) {
    expectSquare(read(binaryStl("solid", square)));
    expectSquare(read(binaryStl("solid facet normal\n", square)));
}

TEST_F(Stl, ReadsAllSolids) {
    const std::string triangle = "facet normal 0 0 1\nouter loop\nvertex 5 0 0\nvertex 6 0 0\nvertex 5 1 0\n"
                                 "endloop\nendfacet\n";
    EXPECT_EQ(
        read("solid\nendsolid\nsolid two\n" + triangle + "endsolid two\n" + textStl).mesh.triangles.size(),
        3u);
}

TEST_F(Stl, FaultsAreRefusedWithTheirPlace) {
    expectRefusal("", {"no triangle"});
    expectRefusal("solid\nendsolid\n", {"no triangle"});
    expectRefusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", {":4: ", "\"x\""});
    expectRefusal(
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\nvertex 0 0 0\nvertex 1 0 0\nendloop\n",
        {":4: ", "no finite float"});
    expectRefusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", {"no triangle"});
    expectRefusal("solid\nv 1 2 3\n", {":2: ", "\"v\"", "endsolid"});
    const std::string whole = binaryStl("of some program", square);
    expectRefusal(whole.substr(0, 84 + 49), {"announces 2 triangles, and has bytes for 0"});
    std::vector<Triangle> infinite = square;
    infinite[1][0][0] = std::numeric_limits<float>::infinity();
    expectRefusal(binaryStl("of some program", infinite), {": byte 134: ", "no finite float"});
    expectRefusal("\x1f\x8b" + std::string(100, '\1'), {"gzip"});
}

TEST_F(Stl, BlanksOfAnyKindSeparateWords) {
    std::string oneLine;
    for (const char c : textStl)
        oneLine += c == '\n' ? '\t' : c;
    expectSquare(read(oneLine));
    std::string manyLines = "\xEF\xBB\xBF"; // and a byte order mark
    for (const char c : "solid\n" + textStl.substr(textStl.find('\n') + 1,
                                                   textStl.rfind(" a name") - textStl.find('\n') - 1))
        manyLines += c == ' ' ? std::string("\r\n\v") : std::string(1, c);
    expectSquare(read(manyLines));
    expectSquare(read("solid a facet holder, vertex by vertex\n" + textStl.substr(textStl.find('\n') + 1)));
}

TEST_F(Stl, DamageAtTheEndIsOneWarning) {
    const std::string whole = binaryStl("of some program", square);
    const auto expectWarning = [&](const std::string &text, std::size_t triangleCount,
                                   const std::string &part) {
        const ObjMesh loaded = read(text);
        EXPECT_EQ(loaded.mesh.triangles.size(), triangleCount);
        ASSERT_EQ(loaded.report.warnings.size(), 1u) << part;
        EXPECT_NE(loaded.report.warnings[0].find(part), std::string::npos) << loaded.report.warnings[0];
    };
    expectWarning(whole.substr(0, whole.size() - 1), 1,
                  "announces 2 triangles, and has bytes for 1: 1 are read");
    for (const char *count : {"\xff\xff\xff\xff", "\xff\xff\xff\x7f"}) {
        std::string many = whole;
        many.replace(80, 4, count, 4);
        expectWarning(many, 2, "and has bytes for 2: 2 are read");
    }
    std::string none = whole;
    none.replace(80, 4, 4, '\0');
    expectWarning(none, 2, "announces 0 triangles, and has bytes for 2");
    expectWarning(whole + whole, 2, "and has bytes for 5: 2 are read");
    std::string coloured = whole;
    coloured[coloured.size() - 1] = '\x7f';
    expectWarning(coloured, 2, "what stands behind a triangle, a colour perhaps, is left out");
    expectWarning(textStl + "facet normal 0 0 1 outer loop vertex 0 0 0", 2, "ends within a facet");
    expectWarning(textStl + "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 0 0 1 endloop endfacet", 2,
                  "fewer than three corners");
    expectWarning(textStl + "color 0.5 1 nan\n", 2, "a colour is left out");
}

TEST_F(Stl, MayBeBareOrPlacedByAScene) {
    const Scene bare = loadScene(write("SQUARE.STL", binaryStl("", square)).string()).scene;
    EXPECT_EQ(bare.meshes.at(0).triangles.size(), 2u);
    EXPECT_EQ(bare.lights.size(), 2u);
    static_cast<void>(write("square.stl", textStl));
    const Scene scene = load(R"({"meshes": [{"file": "square.stl", "rotateDegrees": [90, 0, 0]}]})");
    EXPECT_EQ(scene.meshes.at(0).positions.at(2), glm::vec3(1, 0, 1));
}

} // namespace
} // namespace hyalite::core
