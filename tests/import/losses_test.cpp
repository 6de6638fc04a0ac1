// Losses: every key that a format knows and that changes a picture is either read or told, one warning a key.
#include "host/import/load.h"
#include "tests/fixtures/gltf_fixture.h"
#include "tests/fixtures/png_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

struct Key {
    std::string statement;
    std::string told; ///< a part of the warning
};

class LossesOfFormats : public GltfFolder {
  protected:
    void SetUp() override {
        GltfFolder::SetUp();
        (void)write("c.png", onePixelPng(128, 128, 255));
    }

    [[nodiscard]] static std::vector<std::string> warningsOf(const std::filesystem::path &file) {
        const LoadedScene loaded = loadScene(file.string());
        std::vector<std::string> all = loaded.warnings;
        for (const MeshReport &report : loaded.meshReports)
            all.insert(all.end(), report.warnings.begin(), report.warnings.end());
        return all;
    }
    static void expectOne(const std::filesystem::path &file, const Key &key) {
        const std::vector<std::string> warnings = warningsOf(file);
        ASSERT_EQ(warnings.size(), 1u) << key.statement << ::testing::PrintToString(warnings);
        EXPECT_NE(warnings[0].find(key.told), std::string::npos) << warnings[0];
    }
};

TEST_F(LossesOfFormats, OfObjAreTold) {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
    EXPECT_TRUE(warningsOf(write("a.obj", triangle)).empty());
    const Key keys[] = {{"l 1 2", "a line is left out"},
                        {"p 1", "points are left out"},
                        {"f 1 2", "fewer than three corners"}};
    for (const Key &key : keys)
        expectOne(write("a.obj", triangle + key.statement + "\n"), key);
    // The rest of the specification: free-form surfaces, and what programs of 1995 rendered by.
    for (const char *statement : {"vp 0 0 1",
                                  "cstype bezier",
                                  "deg 3",
                                  "bmat u 1 0 0 1",
                                  "step 1 1",
                                  "curv 0 1 1 2",
                                  "curv2 1 2",
                                  "surf 0 1 0 1 1 2 3 4",
                                  "parm u 0 1",
                                  "trim 0 1 1",
                                  "hole 0 1 1",
                                  "scrv 0 1 1",
                                  "sp 1",
                                  "end",
                                  "con 1 0 1 1 2 0 1 1",
                                  "usemap wood",
                                  "maplib a.map",
                                  "shadow_obj a.obj",
                                  "trace_obj a.obj",
                                  "ctech cparm 1",
                                  "stech cparma 1 1",
                                  "call a.obj",
                                  "csh echo",
                                  "bzp 1 2",
                                  "cdc 1 2",
                                  "res 1 2"})
        expectOne(write("a.obj", triangle + statement + "\n"), {statement, "is no statement that is read"});
    for (const char *statement :
         {"g a", "o b", "s 1", "mg 1 0.5", "lod 3", "bevel on", "c_interp on", "d_interp on", "# comment"})
        EXPECT_TRUE(warningsOf(write("a.obj", triangle + statement + "\n")).empty()) << statement;
}

TEST_F(LossesOfFormats, OfMtlAreTold) {
    const std::filesystem::path mesh =
        write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    for (const char *statement : {"map_Ka c.png", "map_Ks c.png", "map_Ns c.png", "map_Ps c.png",
                                  "map_Pc c.png", "map_Tr c.png", "map_Tf c.png", "map_refl c.png",
                                  "map_disp c.png", "disp c.png", "decal c.png", "refl -type sphere c.png"}) {
        (void)write("a.mtl", std::string("newmtl m\nKd 1 0 0\n") + statement + "\n");
        const std::vector<std::string> warnings = warningsOf(mesh);
        ASSERT_FALSE(warnings.empty()) << statement;
        EXPECT_NE(warnings.back().find("is left out; textures are read for"), std::string::npos)
            << warnings.back();
    }
    const Key keys[] = {{"Tf 0.5 1 1", "Tf 0.5 is left out"},
                        {"Ps 0.5", "Ps 0.5 is left out"},
                        {"aniso 0.5", "aniso 0.5 is left out"},
                        {"anisor 0.5", "anisor 0.5 is left out"},
                        {"Kd 255 128 0", "Kd 255 counts as 1; allowed are from 0 to 1"},
                        {"d -0.5", "d -0.5 counts as 0; allowed are from 0 to 1"},
                        {"Ke 1e38 0 0", "counts as 1e+30; allowed are from 0 to 1e+30"},
                        {"Kd spectral a.rfl 1", "Kd has \"spectral\""},
                        {"Tr 1", "taken for opaque"},
                        {"Pc 1\nd 0.5", "what is transparent has no coat"},
                        {"map_Kd -blendu off c.png", "the option -blendu off is left out"},
                        {"map_Kd -clamp on c.png", "the option -clamp on"},
                        {"map_Kd -colorspace sRGB -o 0.1 c.png", "the option -colorspace sRGB"},
                        {"map_Kd -cc on c.png", "the option -cc on"},
                        {"map_Kd -mm 0 1 c.png", "the option -mm"},
                        {"map_Kd -t 1 1 1 c.png", "the option -t"},
                        {"map_Kd -texres 64 c.png", "the option -texres"},
                        {"map_Kd -boost 2 c.png", "the option -boost"},
                        {"map_d -imfchan m c.png", "the option -imfchan m"},
                        {"map_Kd none.png", "there is no such file"}};
    for (const Key &key : keys) {
        (void)write("a.mtl", "newmtl m\nKd 1 0 0\n" + key.statement + "\n");
        expectOne(mesh, key);
    }
    for (const char *statement : {"Ka 1 1 1", "Tf 1 1 1", "Ps 0", "Pc 0", "Pcr 0.03", "aniso 0", "anisor 0",
                                  "sharpness 60", "map_aat on", "illum 4", "Ni 1.5", "Ns 10", "d -halo 1"}) {
        (void)write("a.mtl", std::string("newmtl m\nKd 1 0 0\n") + statement + "\n");
        EXPECT_TRUE(warningsOf(mesh).empty()) << statement;
    }
}

TEST_F(LossesOfFormats, OfGltfAreTold) {
    const auto withMaterial = [](const char *text) {
        GltfMaker maker = oneTriangle();
        nlohmann::json &primitive = maker.json["meshes"][0]["primitives"][0];
        primitive["material"] = 0;
        primitive["attributes"]["TEXCOORD_0"] = maker.addVec2({0, 0, 1, 0, 0, 1});
        maker.json["textures"] = {{{"source", 0}}};
        maker.json["images"] = {{{"uri", "c.png"}}};
        maker.json["materials"] = {nlohmann::json::parse(text)};
        return maker;
    };
    EXPECT_TRUE(warningsOf(write("a.glb", withMaterial("{}").glb())).empty());
    const Key materials[] = {
        {R"({"occlusionTexture": {"index": 0}})", "/materials/0/occlusionTexture: left out"},
        {R"({"extensions": {"KHR_materials_volume": {"thicknessFactor": 1, "thicknessTexture": {"index": 0}}}})",
         "thicknessTexture: left out"}};
    for (const Key &key : materials)
        expectOne(write("a.glb", withMaterial(key.statement.c_str()).glb()), key);
    for (const char *attribute : {"COLOR_1", "TEXCOORD_2"}) {
        GltfMaker maker = oneTriangle();
        maker.json["meshes"][0]["primitives"][0]["attributes"][attribute] =
            maker.addVec3({1, 0, 0, 1, 0, 0, 1, 0, 0});
        expectOne(write("a.glb", maker.glb()), {attribute, std::string(attribute) + ": left out"});
    }
    GltfMaker variants = oneTriangle();
    variants.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}};
    expectOne(write("a.glb", variants.glb()), {"variants", "the default ones are shown"});
    for (const char *extension : {"KHR_materials_volume_scatter", "KHR_texture_basisu",
                                  "KHR_animation_pointer", "MSFT_lod", "KHR_xmp_json_ld"}) {
        GltfMaker maker = oneTriangle();
        maker.json["extensionsUsed"] = {extension};
        expectOne(write("a.glb", maker.glb()), {extension, extension});
    }
    GltfMaker lamp = oneTriangle();
    lamp.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"range", 5}}};
    lamp.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    expectOne(write("a.glb", lamp.glb()), {"range", "/range: passed over"});
    for (const int mode : {0, 1, 2, 3}) {
        GltfMaker maker = oneTriangle();
        nlohmann::json drawing = maker.json["meshes"][0]["primitives"][0];
        drawing["mode"] = mode;
        maker.json["meshes"][0]["primitives"].push_back(drawing);
        expectOne(write("a.glb", maker.glb()),
                  {"mode", mode == 0 ? "points are passed over" : "lines are passed over"});
    }
}

} // namespace
} // namespace hyalite::core
