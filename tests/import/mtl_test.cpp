// Material libraries of OBJ files.
#include "host/import/mtl.h"

#include "host/import/load.h"
#include "host/packing/packed_scene.h"
#include "tests/fixtures/png_fixture.h"
#include "tests/fixtures/scene_json_fixture.h"

#include <chrono>

namespace hyalite::core {
namespace {

class Mtl : public SceneFolder {
  protected:
    [[nodiscard]] std::vector<Material> loadLibrary(const std::string &name, const std::string &text) {
        FileFinder files(std::filesystem::canonical(folder));
        Losses losses;
        std::vector<Material> materials = loadMtl(write(name, text), {files, library, losses});
        warnings = losses.warnings();
        return materials;
    }

    /// An image of one pixel with alpha.
    void writePixelWithAlpha(const std::string &name, std::uint8_t alpha) const {
        constexpr std::uint8_t colourAndAlpha = 6;
        static_cast<void>(write(name, storedPng(colourAndAlpha, {9, 8, 7, alpha})));
    }

    /// An image of one pixel.
    void writePixel(const std::string &name, std::uint8_t red, std::uint8_t green, std::uint8_t blue) const {
        static_cast<void>(write(name, onePixelPng(red, green, blue)));
    }

    TextureLibrary library;
    std::vector<std::string> warnings;
};

TEST_F(Mtl, SaysWhatMaterialsAreMadeOf) {
    const std::vector<Material> materials = loadLibrary("all.mtl", R"(# a comment
newmtl chalk
Kd 0.5 0.25 1.5   # more than 1 is 1
newmtl lamp
Kd 0
Ke 3 2 1
newmtl varnish
Kd 0.1 0.2 0.3
Ks 0.5 0.5 0.5
Ns 30
newmtl brass plate
illum 3
Ks 0.9 0.7 0.4
Ns 126
newmtl window
illum 7
Ni 1.33
newmtl modern
Kd 0.4 0.4 0.4
Pr 0.3
Pm 0.6
map_Kd wood.png
newmtl veil
d 0.25
newmtl chalk
Kd 0 0 0
)");
    ASSERT_EQ(materials.size(), 7u) << "the second chalk is left out";
    EXPECT_EQ(materials[0].kind, MaterialKind::Diffuse);
    EXPECT_EQ(materials[0].albedo, glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_TRUE(materials[0].twoSided);
    EXPECT_EQ(materials[1].emission, glm::vec3(3, 2, 1));
    EXPECT_EQ(materials[2].kind, MaterialKind::Principled);
    EXPECT_EQ(materials[2].specular, 0.5f);
    EXPECT_NEAR(materials[2].roughness, 0.5, 1e-6) << "(2 / 32)^(1/4)";
    EXPECT_EQ(materials[3].name, "brass plate");
    EXPECT_EQ(materials[3].metallic, 1.0f);
    EXPECT_EQ(materials[3].albedo, glm::vec3(0.9f, 0.7f, 0.4f));
    EXPECT_EQ(materials[4].kind, MaterialKind::Dielectric);
    EXPECT_EQ(materials[4].refractiveIndex, 1.33f);
    EXPECT_EQ(materials[5].roughness, 0.3f);
    EXPECT_EQ(materials[5].metallic, 0.6f);
    EXPECT_EQ(materials[6].transmission, 0.75f);
}

TEST_F(Mtl, StatementsThatCannotBeReadAreLeftOutWithOneWarningAKind) {
    const std::vector<Material> materials = loadLibrary("bad.mtl", R"(
Kd 1 1 1
newmtl a
Kd 1 x 1
Kd 1 1
Kd 0.25 0.5 0.75
Ns nan
Pr 1e99
KE 1,5
map_Kd
map_bump
Map_Kd -s x.png
map_Kd -s 1e9 x.png
newmtl
Kd 1
frobnicate 3
Hue 4
Tf 1 1 1
Tf 0.2 0.2 1
Ps 0
aniso 0.5
Ka 1 1 1
)");
    ASSERT_EQ(materials.size(), 2u);
    EXPECT_EQ(materials[0].albedo, glm::vec3(0.25f, 0.5f, 0.75f)) << "by the one that can be read";
    EXPECT_EQ(materials[0].kind, MaterialKind::Diffuse);
    EXPECT_EQ(materials[1].name, "");
    const char *const parts[] = {
        "bad.mtl:2: Kd comes before the first newmtl, and is left out",
        "bad.mtl:4: Kd has \"x\", which is no finite number; the statement is left out (and 1 more)",
        "bad.mtl:7: Ns has \"nan\", which is no finite number",
        "bad.mtl:8: Pr has \"1e99\"",
        "bad.mtl:9: KE has \"1,5\"",
        "bad.mtl:10: map_Kd names no file, and is left out (and 1 more)",
        "bad.mtl:12: -s has fewer numbers than it needs; the statement is left out (and 1 more)",
        "bad.mtl:16: the statement \"frobnicate\" is unknown, and left out (and 1 more)",
        "bad.mtl:19: Tf 0.2 is left out",
        "bad.mtl:21: aniso 0.5 is left out",
    };
    ASSERT_EQ(warnings.size(), std::size(parts)) << ::testing::PrintToString(warnings);
    for (std::size_t i = 0; i < warnings.size(); ++i)
        EXPECT_NE(warnings[i].find(parts[i]), std::string::npos) << warnings[i];
}

TEST_F(Mtl, KeywordsMayBeInAnyLetterCase) {
    const std::vector<Material> materials =
        loadLibrary("a.mtl", "NEWMTL a\nKD 0.25 0.5 1\nkS 0 0 0\nD 0.75\n\tNewMtl\tb c \nkd 1\tTR 1\n");
    ASSERT_EQ(materials.size(), 2u);
    EXPECT_EQ(materials[0].albedo, glm::vec3(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(materials[0].transmission, 0.25f);
    EXPECT_EQ(materials[1].name, "b c");
}

TEST_F(Mtl, NumbersTooSmallForAFloatAreZero) {
    const std::vector<Material> materials = loadLibrary("a.mtl", "newmtl a\nKd 1 1e-50 -1e-60\n");
    EXPECT_EQ(materials.at(0).albedo, glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_TRUE(warnings.empty()) << warnings.at(0);
}

TEST_F(Mtl, FilesOfAnotherKindAreToldAsWhatTheyAre) {
    const std::pair<std::string, const char *> files[] = {
        {"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 3\n", "a pointer of Git LFS"},
        {"<!DOCTYPE html><html>", "a web page"},
        {std::string("\xFF\xFEn\0e\0w\0m\0t\0l\0 \0m\0\n\0", 18), "UTF-16"}};
    for (const auto &[content, kind] : files) {
        EXPECT_TRUE(loadLibrary("a.mtl", content).empty());
        ASSERT_EQ(warnings.size(), 1u) << kind;
        EXPECT_NE(warnings[0].find("this is not MTL text; it looks like " + std::string(kind)),
                  std::string::npos)
            << warnings[0];
    }
}

TEST_F(Mtl, BlackVerticesOfAssimpHaveNoColour) {
    static_cast<void>(write("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl painted\nKd 1 1 1\n"));
    const std::string mesh = "mtllib two.mtl\nusemtl painted\nv 0 0 0 0 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0\n"
                             "f 1 2 3\nusemtl red\nv 0 0 1 0 0 0\nv 1 0 1 0 0 0\nf 1 4 5\nf 3 4 5\n";
    const auto cornersOf = [&](const std::string &text) {
        const LoadedScene loaded = loadScene(write("mesh.obj", text).string());
        warnings = loaded.meshReports.at(0).warnings;
        std::vector<glm::vec3> colours;
        const CornerValues<glm::vec4> &values = loaded.scene.meshes.at(0).colours;
        for (const glm::uvec3 &corners : values.corners)
            for (const std::uint32_t corner : {corners.x, corners.y, corners.z})
                colours.emplace_back(values.values.at(corner));
        return colours;
    };
    const glm::vec3 black(0.0f);
    const glm::vec3 green(0.0f, 1.0f, 0.0f);
    EXPECT_EQ(cornersOf(mesh),
              (std::vector<glm::vec3>{black, green, black, black, black, black, black, black, black}));
    EXPECT_TRUE(warnings.empty()) << "black is a colour, too";
    const glm::vec3 white(1.0f);
    EXPECT_EQ(cornersOf("# File produced by Open Asset Import Library (http://www.assimp.sf.net)\n" + mesh),
              (std::vector<glm::vec3>{black, green, black, white, white, white, white, white, white}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("mesh.obj: 2 triangles of materials whose vertices are all black"),
              std::string::npos)
        << warnings[0];
}

TEST_F(Mtl, TexturesAreReadForWhatTheyAreFor) {
    std::filesystem::create_directories(folder / "images of wood");
    writePixel("images of wood/oak.png", 1, 2, 3);
    writePixel("blue.png", 128, 128, 255);
    const std::vector<Material> materials = loadLibrary("textured.mtl", R"(newmtl wood
map_Kd -s 2 3 1 -o 0.25 -0.5 images of wood/oak.png
norm -bm 0.5 blue.png
map_d blue.png
newmtl lamp
Kd 0.25 0.5 1
Ke 0 0 0
map_Ke images of wood\\oak.png
map_Kd -s 4 blue.png
newmtl modern
Pr 0.3
map_Pr blue.png
map_Pm blue.png
)");
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    ASSERT_EQ(materials.size(), 3u);
    const Material &wood = materials[0];
    EXPECT_EQ(wood.kind, MaterialKind::Diffuse);
    EXPECT_EQ(wood.albedo, glm::vec3(1.0f)) << "without Kd the texture alone decides";
    ASSERT_TRUE(wood.textures[layout::slotBaseColour]);
    EXPECT_EQ(wood.textures[layout::slotBaseColour]->scale, glm::vec2(2, 3));
    EXPECT_EQ(wood.textures[layout::slotBaseColour]->offset, glm::vec2(0.25f, -0.5f));
    EXPECT_TRUE(wood.textures[layout::slotOpacity]);
    EXPECT_TRUE(wood.textures[layout::slotNormal]);
    EXPECT_EQ(wood.normalStrength, 0.5f);
    EXPECT_EQ(materials[1].albedo, glm::vec3(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(materials[1].emission, glm::vec3(1.0f));
    ASSERT_TRUE(materials[1].textures[layout::slotEmission]);
    EXPECT_EQ(materials[1].textures[layout::slotEmission]->textureIndex,
              wood.textures[layout::slotBaseColour]->textureIndex)
        << "one file is one texture, and names may be written as on Windows";
    EXPECT_EQ(materials[1].textures[layout::slotBaseColour]->scale, glm::vec2(4, 1));
    EXPECT_EQ(materials[2].kind, MaterialKind::Principled);
    EXPECT_EQ(materials[2].roughness, 1.0f) << "the texture stands instead of Pr";
    EXPECT_EQ(materials[2].metallic, 1.0f);
    EXPECT_EQ(materials[2].specular, 0.5f);
}

TEST_F(Mtl, WhatIsPassedOverOfTexturesIsTold) {
    std::filesystem::create_directories(folder / "mesh");
    writePixel("outside.png", 1, 2, 3);
    writePixel("mesh/grey.png", 9, 9, 9);
    static_cast<void>(write("mesh/photo.tga", "something else"));
    Losses losses;
    FileFinder files(std::filesystem::canonical(folder / "mesh"));
    const std::vector<Material> materials =
        loadMtl(write("mesh/bad.mtl", "newmtl a\nmap_Kd none.png\nmap_Kd ../outside.png\nmap_Ks grey.png\n"
                                      "bump grey.png\nmap_Ke photo.tga\nmap_d -clamp on -t 1 2 grey.png\n"),
                {files, library, losses});
    warnings = losses.warnings();
    ASSERT_EQ(materials.size(), 1u);
    for (std::uint32_t slot = 0; slot < layout::textureSlotCount; ++slot)
        EXPECT_EQ(materials[0].textures[slot].has_value(), slot == layout::slotOpacity) << slot;
    const char *const parts[] = {
        "bad.mtl:2: map_Kd \"none.png\" is left out: there is no such file in the mesh's folder (and 1 more)",
        "bad.mtl:4: map_Ks \"grey.png\" is left out", "bad.mtl:5: bump \"grey.png\" is left out: it is grey",
        "bad.mtl:6: map_Ke \"photo.tga\" is left out: it is not a PNG",
        "bad.mtl:7: the option -clamp on is left out; only -s, -o and -bm are read (and 1 more)"};
    ASSERT_EQ(warnings.size(), std::size(parts));
    for (std::size_t i = 0; i < warnings.size(); ++i)
        EXPECT_NE(warnings[i].find(parts[i]), std::string::npos) << warnings[i];
}

TEST_F(Mtl, DamagedTexturesAreLeftOutWithAWarning) {
    static_cast<void>(write("cut.jpg", "\xFF\xD8\xFF\xE0"));
    writePixel("whole.png", 1, 2, 3);
    const std::vector<Material> materials = loadLibrary(
        "a.mtl", "newmtl a\nmap_Kd cut.jpg\nnewmtl b\nmap_Kd whole.png\nnewmtl c\nmap_Kd cut.jpg\n");
    ASSERT_EQ(materials.size(), 3u);
    EXPECT_FALSE(materials[0].textures[layout::slotBaseColour]);
    EXPECT_EQ(materials[0].albedo, glm::vec3(0.8f)) << "as without a texture";
    ASSERT_TRUE(materials[1].textures[layout::slotBaseColour]);
    EXPECT_EQ(materials[1].textures[layout::slotBaseColour]->textureIndex, 0u);
    EXPECT_FALSE(materials[2].textures[layout::slotBaseColour]);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("a.mtl:2: map_Kd \"cut.jpg\" is left out: "), std::string::npos)
        << warnings[0];
    EXPECT_NE(warnings[0].find("cut.jpg: it is damaged"), std::string::npos) << warnings[0];
    EXPECT_TRUE(warnings[0].ends_with("(and 1 more)")) << warnings[0];
}

TEST_F(Mtl, TheAlphaOfMapKdCutsOutWithoutAMapD) {
    writePixelWithAlpha("leaf.png", 0);
    writePixelWithAlpha("glass.png", 200);
    writePixel("mask.png", 255, 255, 255);
    const std::vector<Material> materials = loadLibrary(
        "a.mtl", "newmtl leaf\nmap_Kd -s 2 2 leaf.png\nnewmtl masked\nmap_Kd leaf.png\nmap_d mask.png\n"
                 "newmtl dense\nmap_Kd glass.png\n");
    ASSERT_EQ(materials.size(), 3u);
    const auto &opacity = materials[0].textures[layout::slotOpacity];
    ASSERT_TRUE(opacity);
    EXPECT_EQ(opacity->textureIndex, materials[0].textures[layout::slotBaseColour]->textureIndex);
    EXPECT_EQ(opacity->scale, glm::vec2(2.0f));
    EXPECT_NE(materials[1].textures[layout::slotOpacity]->textureIndex, opacity->textureIndex);
    EXPECT_FALSE(materials[2].textures[layout::slotOpacity]) << "nothing of it is below a half";
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("\"leaf\" is cut out where map_Kd \"leaf.png\" is transparent"),
              std::string::npos)
        << warnings[0];
}

TEST_F(Mtl, APictureAsMapBumpIsANormalMapIfItsColoursAreNormals) {
    writePixel("normal.png", 100, 140, 250);
    writePixel("bricks.png", 150, 70, 40);
    const std::vector<Material> materials = loadLibrary(
        "a.mtl", "newmtl a\nmap_Bump normal.png\nnewmtl b\nbump bricks.png\nnewmtl c\nnorm bricks.png\n");
    EXPECT_TRUE(materials.at(0).textures[layout::slotNormal]);
    EXPECT_FALSE(materials.at(1).textures[layout::slotNormal]);
    EXPECT_TRUE(materials.at(2).textures[layout::slotNormal]) << "as it says";
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("a.mtl:4: bump \"bricks.png\" is left out: its colours"), std::string::npos);
}

TEST_F(Mtl, WordsOfUnknownOptionsAreNotTakenForTheName) {
    writePixel("old oak.png", 1, 2, 3);
    const std::vector<Material> materials = loadLibrary(
        "a.mtl", "newmtl a\nmap_Kd -gamut linear old oak.png\nnewmtl b\nmap_Kd -mm 0 1 old oak.png\n"
                 "newmtl c\nmap_Kd old oak.png -s 1 1 1\n");
    for (const Material &material : materials)
        EXPECT_TRUE(material.textures[layout::slotBaseColour]) << material.name;
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(
        warnings[0].find("a.mtl:2: the option -gamut is left out; only -s, -o and -bm are read (and 1 more)"),
        std::string::npos)
        << warnings[0];
    EXPECT_NE(warnings[1].find("a.mtl:6: \"-s 1 1 1\" is left out"), std::string::npos) << warnings[1];
}

TEST_F(Mtl, NamesOfOtherComputersAreFoundBesideTheFile) {
    std::filesystem::create_directories(folder / "Textures");
    writePixel("Textures/Wood.png", 1, 2, 3);
    writePixel("stone.PNG", 1, 2, 3);
    static_cast<void>(write("Colours.mtl",
                            "newmtl a\nmap_Kd C:\\models\\textures\\wood.PNG\nmap_Ke STONE.png\n"
                            "newmtl b\nmap_Kd /home/bob/stone.PNG\nnewmtl c\nmap_Kd \"stone.PNG\"\n"));
    const LoadedScene loaded =
        loadScene(write("mesh.obj",
                        "mtllib .\\colours.MTL\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n")
                      .string());
    ASSERT_EQ(loaded.scene.materials.size(), 4u);
    EXPECT_TRUE(loaded.scene.materials[1].textures[layout::slotBaseColour]);
    EXPECT_TRUE(loaded.scene.materials[1].textures[layout::slotEmission]);
    EXPECT_TRUE(loaded.scene.materials[2].textures[layout::slotBaseColour]);
    EXPECT_TRUE(loaded.scene.materials[3].textures[layout::slotBaseColour]);
    EXPECT_EQ(loaded.scene.textures.size(), 2u);
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(
        loaded.meshReports[0].warnings[0].find("5 files were found by another name than it says, such as "
                                               "\".\\colours.MTL\", which is Colours.mtl"),
        std::string::npos)
        << loaded.meshReports[0].warnings[0];
}

TEST_F(Mtl, NamesOfLibrariesMayHaveBlanks) {
    static_cast<void>(write("a b.mtl", "newmtl red\n"));
    static_cast<void>(write("c.mtl d.mtl", "newmtl green\n"));
    static_cast<void>(write("e f.mtl", "newmtl blue\n"));
    const LoadedScene loaded =
        loadScene(write("mesh.obj", "mtllib a b.mtl  e f.mtl\nmtllib c.mtl d.mtl\nusemtl blue\n"
                                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
                      .string());
    EXPECT_EQ(loaded.scene.materials.size(), 4u);
    EXPECT_TRUE(loaded.meshReports.at(0).warnings.empty());
}

TEST_F(Mtl, SeveralLibrariesMayBeNamedAtOnce) {
    static_cast<void>(write("a.mtl", "newmtl red\n"));
    static_cast<void>(write("b.mtl", "newmtl blue\n"));
    const LoadedScene loaded = loadScene(
        write("mesh.obj", "mtllib a.mtl b.mtl\nusemtl blue\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string());
    EXPECT_EQ(loaded.scene.materials.size(), 3u);
    EXPECT_TRUE(loaded.meshReports.at(0).warnings.empty());
}

TEST_F(Mtl, ABareMeshWearsItsTextures) {
    writePixel("red.png", 255, 0, 0);
    static_cast<void>(write("red.mtl", "newmtl red\nmap_Kd red.png\n"));
    const std::string vertices = "mtllib red.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    const LoadedScene worn =
        loadScene(write("a.obj", vertices + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n").string());
    EXPECT_EQ(worn.scene.textures.size(), 1u);
    EXPECT_TRUE(worn.scene.materials.at(1).textures[layout::slotBaseColour]);
    EXPECT_TRUE(worn.meshReports.at(0).warnings.empty());
    const LoadedScene partly =
        loadScene(write("b.obj", vertices + "vt 0 0\nf 1/1 2/1 3/1\nf 1 2 4\n").string());
    ASSERT_EQ(partly.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(partly.meshReports.at(0).warnings[0].find("1 triangles have no texture coordinates"),
              std::string::npos);
    const LoadedScene plain = loadScene(
        write("d.obj", vertices + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nusemtl none\nf 1 2 4\n").string());
    ASSERT_EQ(plain.meshReports.at(0).warnings.size(), 1u) << "of the material, not of coordinates";
    EXPECT_NE(plain.meshReports.at(0).warnings[0].find("1 usemtl statement"), std::string::npos);
    const LoadedScene bare = loadScene(write("c.obj", vertices + "f 1 2 3\n").string());
    EXPECT_FALSE(bare.scene.materials.at(1).textures[layout::slotBaseColour]);
    ASSERT_EQ(bare.meshReports.at(0).warnings.size(), 1u);
}

TEST_F(Mtl, ABareMeshHasItsMaterials) {
    static_cast<void>(write("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl glass\nillum 4\n"));
    const std::string faces =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
        "f 1 2 3\nusemtl glass\nf 1 2 4\nf 1 3 9\nusemtl red\nf 2 3 4\nusemtl lost\nf 1 3 4\n"
        "v 5 5 5\nv 6 6 7\nv 7 8 9\nv 5 5 6\nv 1 2 8\n";
    const LoadedScene loaded = loadScene(write("mesh.obj", "mtllib two.mtl\n" + faces).string());
    const TriangleMesh &mesh = loaded.scene.meshes.at(0);
    ASSERT_EQ(loaded.scene.materials.size(), 3u);
    EXPECT_EQ(loaded.scene.materials[1].name, "red");
    EXPECT_EQ(loaded.scene.materials[2].name, "glass");
    ASSERT_EQ(mesh.triangles.size(), 5u);
    // Faces wait for a vertex that comes later, and all behind them; each keeps its own material.
    EXPECT_EQ(mesh.triangleMaterials, (std::vector<std::uint32_t>{0, 2, 2, 1, 0}));
    EXPECT_EQ(loaded.meshReports.at(0).unknownMaterialCount, 1u);
    // As packed for the renderers.
    const PackedScene packed =
        packScene(loaded.scene, buildBvh(TreeKind::Sah, buildTriangles(loaded.scene), 1));
    EXPECT_TRUE(packed.hasDielectric);
    for (const layout::TriangleRecord &triangle : packed.triangles) {
        const std::uint32_t input = triangle.primitiveId - layout::minFirstTriangleId;
        const bool isGlass = input == 1 || input == 2;
        EXPECT_EQ(kindOf(packed.materials.at(triangle.materialIndex)) == layout::materialDielectric, isGlass);
        EXPECT_EQ((triangle.flags & layout::triangleIsTransmissive) != 0, isGlass);
    }
}

TEST_F(Mtl, NamesInMessagesAreFitForTerminals) {
    static_cast<void>(loadLibrary("a.mtl", "newmtl a\x1b[31m\nTr 1\n"));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("[31m\" has Tr 1"), std::string::npos) << warnings[0];
    EXPECT_EQ(warnings[0].find('\x1b'), std::string::npos);
}

TEST_F(Mtl, LibrariesAreReadOnceAndMaterialsFoundAtOnce) {
    // Without that these are a million readings of one file, and a billion comparisons of names.
    std::string manyMaterials;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 20'000; ++i) {
        manyMaterials += "newmtl material number " + std::to_string(i) + "\nKd 1 0 0\n";
        text += "mtllib many.mtl\nmtllib ./many.mtl\nmtllib none.mtl\nusemtl material number " +
                std::to_string(19'999 - i) + "\nf 1 2 3\n";
    }
    static_cast<void>(write("many.mtl", manyMaterials));
    const auto start = std::chrono::steady_clock::now();
    const LoadedScene loaded = loadScene(write("mesh.obj", text).string());
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_EQ(loaded.meshReports.at(0).unknownMaterialCount, 0u);
    EXPECT_EQ(loaded.meshReports.at(0).lostLibraries, (std::vector<std::string>{"none.mtl"}));
    EXPECT_EQ(loaded.scene.meshes.at(0).triangleMaterials.at(0), 20'000u);
    EXPECT_EQ(loaded.scene.meshes.at(0).triangleMaterials.at(19'999), 1u);
}

TEST_F(Mtl, LibrariesThatAreNotThereOrOutOfReachAreTold) {
    std::filesystem::create_directories(folder / "below");
    static_cast<void>(write("outside.mtl", "newmtl red\nKd 1 0 0\n"));
    const LoadedScene loaded =
        loadScene(write("below/mesh.obj", "mtllib ../outside.mtl\nmtllib none.mtl\nusemtl red\n"
                                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
                      .string());
    EXPECT_EQ(loaded.meshReports.at(0).lostLibraries,
              (std::vector<std::string>{"../outside.mtl", "none.mtl"}));
    EXPECT_TRUE(loaded.scene.meshes.at(0).triangleMaterials.empty());
    EXPECT_EQ(loaded.scene.materials.size(), 1u) << "the neutral one";
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u) << "once";
    EXPECT_NE(
        loaded.meshReports[0].warnings[0].find(
            "mesh.obj: there is no material library \"../outside.mtl\" (nor 1 more) in the mesh's folder"),
        std::string::npos)
        << loaded.meshReports[0].warnings[0];
}

} // namespace
} // namespace hyalite::core
