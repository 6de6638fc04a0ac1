// Material libraries of OBJ files.
#include "host/scene/mtl.h"

#include "host/bvh/packed_scene.h"
#include "host/scene/load.h"
#include "tests/unit/scene_json_fixture.h"

#include <chrono>

namespace hyalite {
namespace {

using Mtl = SceneFolder;

TEST_F(Mtl, SaysWhatMaterialsAreMadeOf) {
    const std::vector<Material> materials = loadMtl(write("all.mtl", R"(# a comment
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
)"));
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

TEST_F(Mtl, RefusesWhatIsNoNumber) {
    const auto refusalOfMtl = [&](const std::string &text) -> std::string {
        try {
            static_cast<void>(loadMtl(write("bad.mtl", text)));
        } catch (const Error &error) {
            EXPECT_EQ(error.exitCode, ExitCode::BadInput);
            return error.what();
        }
        return {};
    };
    EXPECT_NE(refusalOfMtl("newmtl a\nKd 1 x 1\n").find("bad.mtl:2: Kd has \"x\"; allowed are"),
              std::string::npos)
        << refusalOfMtl("newmtl a\nKd 1 x 1\n");
    EXPECT_NE(refusalOfMtl("newmtl a\nKd 1 1\n").find("fewer numbers"), std::string::npos);
    EXPECT_NE(refusalOfMtl("newmtl a\nNs nan\n").find("bad.mtl:2: Ns"), std::string::npos);
    EXPECT_NE(refusalOfMtl("\nKd 1 1 1\n").find("bad.mtl:2: Kd stands before the first newmtl"),
              std::string::npos);
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
        const std::uint32_t input = triangle.primitiveId - layout::firstTriangleId;
        const bool isGlass = input == 1 || input == 2;
        EXPECT_EQ(packed.materials.at(triangle.materialIndex).kind == layout::materialDielectric, isGlass);
        EXPECT_EQ((triangle.flags & layout::triangleIsTransmissive) != 0, isGlass);
    }
}

TEST_F(Mtl, LibrariesAreReadOnceAndMaterialsFoundAtOnce) {
    // Without that these are a million readings of one file, and a billion comparisons of names.
    std::string library;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 20'000; ++i) {
        library += "newmtl material number " + std::to_string(i) + "\nKd 1 0 0\n";
        text += "mtllib many.mtl\nmtllib ./many.mtl\nmtllib none.mtl\nusemtl material number " +
                std::to_string(19'999 - i) + "\nf 1 2 3\n";
    }
    static_cast<void>(write("many.mtl", library));
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
}

} // namespace
} // namespace hyalite
