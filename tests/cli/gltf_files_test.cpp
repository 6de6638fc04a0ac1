// glTF files as users give them: the shape of the picture, turntables, what inspect lists; and files of other formats.
#include "host/image/image.h"
#include "tests/cli/command_line.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace hyalite::core::testing {
namespace {

class GltfFiles : public CommandLine {
  protected:
    /// A triangle, and a camera of that shape at (0, 0, 5).
    void storeSeen(const std::string &name, const nlohmann::json &perspective) const {
        GltfMaker maker = oneTriangle();
        maker.json["cameras"] = {{{"type", "perspective"}, {"perspective", perspective}}};
        maker.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 5}}});
        maker.json["scenes"][0]["nodes"] = {0, 1};
        store(name, maker.glb());
    }
    /// "WIDTHxHEIGHT" of a picture.
    [[nodiscard]] std::string sizeOf(const std::string &line) const {
        const Image image = renderImage(line + " --spp 1 --device cpu --integrator albedo");
        return fmt::format("{}x{}", image.width(), image.height());
    }
};

TEST_F(GltfFiles, CamerasDecideTheShapeOfThePicture) {
    storeSeen("wide.glb", {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 2}});
    storeSeen("high.glb", {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 0.25}});
    storeSeen("thin.glb", {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 1e30}});
    storeSeen("none.glb", {{"yfov", 0.5}, {"znear", 0.1}});
    EXPECT_EQ(sizeOf("wide.glb"), "512x256");
    EXPECT_EQ(sizeOf("high.glb"), "128x512");
    EXPECT_EQ(sizeOf("thin.glb"), "512x1");
    EXPECT_EQ(sizeOf("none.glb"), "512x512");
    EXPECT_EQ(sizeOf("wide.glb --width 30"), "30x15");
    EXPECT_EQ(sizeOf("wide.glb --height 30"), "60x30");
    EXPECT_EQ(sizeOf("wide.glb --width 30 --height 40"), "30x40");
    EXPECT_EQ(sizeOf("none.glb --width 30 --height 40"), "30x40");
}

TEST_F(GltfFiles, TurntablesTurnTiltedCamerasAboutY) {
    // A camera at (0, 3, 4) that looks down to the origin and is rolled; half a turn later it is at (0, 3, -4).
    const auto storeAt = [&](const std::string &name, bool isBehind) {
        GltfMaker maker;
        const std::size_t positions =
            maker.addVec3({-1, 0, -1, 1, 0, -1, 0, 0, 1, 0.5, 1, 0.5, -1, -1, 1, 0.5, 0, 0});
        maker.json["meshes"] = {
            {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"material", 0}}}}}};
        maker.json["materials"] = {{{"doubleSided", true}}};
        maker.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 0.1}}}}};
        const double half = 0.5 * std::atan2(3.0, 4.0);
        maker.json["nodes"].push_back(
            {{"rotation", {0, isBehind ? 1 : 0, 0, isBehind ? 0 : 1}}, {"children", {2}}});
        maker.json["nodes"].push_back({{"translation", {0, 3, 4}},
                                       {"rotation", {-std::sin(half), 0, 0, std::cos(half)}},
                                       {"children", {3}}});
        maker.json["nodes"].push_back({{"rotation", {0, 0, std::sin(0.3), std::cos(0.3)}}, {"camera", 0}});
        maker.json["scenes"][0]["nodes"] = {0, 1};
        store(name, maker.glb());
    };
    storeAt("front.glb", false);
    storeAt("behind.glb", true);
    const std::string options = " --width 48 --height 48 --spp 4 --device cpu --integrator normal";
    ASSERT_EQ(run("render front.glb --turntable 2 -o t.#.pfm --quiet" + options).exitCode, 0);
    EXPECT_EQ(load("t.0.pfm"), renderPfm("front.glb" + options));
    static_cast<void>(renderImage("behind.glb" + options));
    const Outcome diff = run("diff t.1.pfm rendered.pfm --min-psnr 45");
    EXPECT_EQ(diff.exitCode, 0) << diff;
    EXPECT_EQ(run("diff t.0.pfm t.1.pfm --min-psnr 45").exitCode, 1);
}

TEST_F(GltfFiles, CutoffsAboveOneHide) {
    GltfMaker maker = oneTriangle();
    maker.json["meshes"][0]["primitives"][0]["material"] = 0;
    maker.json["materials"] = {{{"alphaMode", "MASK"}, {"alphaCutoff", 1}, {"doubleSided", true}}};
    const auto brightest = [&] {
        store("cut.glb", maker.glb());
        const Image image = renderImage("cut.glb --integrator albedo --width 16 --height 16 --spp 1");
        float most = 0.0f;
        for (const glm::vec3 &pixel : image.pixels())
            most = std::max(most, pixel.x);
        return most;
    };
    EXPECT_GT(brightest(), 0.5f);
    maker.json["materials"][0]["alphaCutoff"] = 1.01;
    EXPECT_EQ(brightest(), 0.0f);
    maker.json["materials"][0]["alphaMode"] = "OPAQUE";
    EXPECT_GT(brightest(), 0.5f);
}

TEST_F(GltfFiles, SpotsFallOffAsTheSpecificationSays) {
    // A spot 2 above a floor that is seen from straight above, a pixel each 0.1; the same place under a point light.
    GltfMaker maker;
    const std::size_t positions = maker.addVec3({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0});
    maker.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
    maker.json["cameras"] = {{{"type", "orthographic"},
                              {"orthographic", {{"xmag", 0.65}, {"ymag", 0.65}, {"znear", 0}, {"zfar", 9}}}}};
    maker.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 5}}});
    maker.json["nodes"].push_back(
        {{"translation", {0, 0, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    maker.json["scenes"][0]["nodes"] = {0, 1, 2};
    nlohmann::json &light = maker.json["extensions"]["KHR_lights_punctual"]["lights"][0];
    const auto picture = [&](const nlohmann::json &value) {
        light = value;
        store("light.glb", maker.glb());
        return renderImage("light.glb --width 13 --height 13 --spp 1 --sampler centre");
    };
    const Image point = picture({{"type", "point"}});
    const Image spot = picture({{"type", "spot"}, {"spot", {{"outerConeAngle", 0.35}}}});
    for (const auto &[offset, share] : {std::pair{0, 1.0}, {2, 0.8430}, {4, 0.4620}, {6, 0.0926}})
        EXPECT_NEAR(spot.at(6 + offset, 6).x / point.at(6 + offset, 6).x, share, 1e-3) << offset;
    EXPECT_EQ(spot.at(12, 0).x, 0.0f);
}

TEST_F(GltfFiles, InspectListsCamerasAndNodes) {
    GltfMaker maker = oneTriangle();
    maker.json["cameras"] = {
        {{"type", "perspective"}, {"name", "left\u001b[31m\n"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    maker.json["meshes"][0]["name"] = "lid";
    maker.json["nodes"][0]["name"] = "pot";
    maker.json["nodes"][0]["children"] = {1};
    maker.json["nodes"].push_back({{"name", "eye"}, {"camera", 1}, {"translation", {0, 0, 5}}});
    store("pot.glb", maker.glb());
    const std::string text = run("inspect pot.glb").output;
    for (const char *line :
         {"of the file  camera 0 \"left", "of the file  camera 1: perspective\n",
          "of the file  node 0 \"pot\": mesh 0 \"lid\"\n", "of the file    node 1 \"eye\": camera 1\n"})
        EXPECT_TRUE(contains(text, line)) << line << '\n' << text;
    EXPECT_FALSE(contains(text, "\u001b")) << text;
    for (int i = 0; i < 100; ++i) // a chain
        maker.json["nodes"].push_back({{"children", {i + 3}}});
    maker.json["nodes"].push_back({{"name", "deepest"}});
    maker.json["nodes"][1]["children"] = {2};
    store("deep.glb", maker.glb());
    const std::string deep = run("inspect deep.glb").output;
    EXPECT_TRUE(contains(deep, "and 71 more nodes of the file")) << deep;
    EXPECT_FALSE(contains(deep, "deepest"));
    EXPECT_FALSE(contains(run("inspect cat").output, "of the file"));
}

/// A square of COLLADA over [-1, 1]^2.
std::string squareDae() {
    return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Y_UP</up_axis></asset>
  <library_geometries><geometry id="square"><mesh>
    <source id="places"><float_array id="numbers" count="12">-1 -1 0 1 -1 0 1 1 0 -1 1 0</float_array>
      <technique_common><accessor source="#numbers" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="corners"><input semantic="POSITION" source="#places"/></vertices>
    <triangles count="2"><input semantic="VERTEX" source="#corners" offset="0"/><p>0 1 2 0 2 3</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="scene">
    <node id="node"><instance_geometry url="#square"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>)";
}

TEST_F(GltfFiles, TheCommandForAnotherFormatMakesAFileThatIsRead) {
    store("square.dae", squareDae());
    const std::string error =
        expectFailure("render square.dae -o a.png", 3, {"it is COLLADA, which is not read"});
    const std::string command = "assimp export square.dae square.glb";
    ASSERT_TRUE(contains(error, ": " + command + " (Debian: assimp-utils)")) << error;
    ASSERT_EQ(std::system("command -v assimp >/dev/null"), 0)
        << "this test needs assimp: install assimp-utils (cmake/run.sh test does)";
    ASSERT_EQ(std::system(("cd '" + folder.string() + "' && " + command + " >log.txt 2>&1").c_str()), 0)
        << load("log.txt");
    const std::string text = run("inspect square.glb").output;
    EXPECT_TRUE(contains(text, "2 triangles in 1 mesh")) << text;
    EXPECT_TRUE(contains(text, "bounds       (-1, -1, 0) to (1, 1, 0)")) << text;
    const Image image =
        renderImage("square.glb --integrator albedo --width 16 --height 16 --spp 1 --device cpu");
    EXPECT_GT(image.at(8, 8).x, 0.0f);
}

TEST_F(GltfFiles, OtherFormatsAreKnownByNameAndByContent) {
    const std::string usdz = std::string("PK\x03\x04", 4) + std::string(22, '\0') +
                             std::string("\x08\0\0\0", 4) + "cube.usd" + "PXR-USDC";
    const std::string threeMf = std::string("PK\x03\x04", 4) + std::string(40, '\0') + "3D/3dmodel.model";
    const struct {
        std::string name;
        std::string content;
        std::vector<std::string> parts;
    } files[] = {
        {"a.fbx", "", {"FBX", "assimp export a.fbx a.glb"}},
        {"A B.FBX", "", {"FBX", "assimp export 'A B.FBX' 'A B.glb'"}},
        {"a.glb", "Kaydara FBX Binary  ", {"FBX", "assimp export a.glb a.converted.glb"}},
        {"b.obj", "; FBX 7.4.0 project file\n", {"FBX", "assimp export b.obj b.glb"}},
        {"a.3mf", threeMf, {"3MF", "assimp export a.3mf a.glb"}},
        {"a.3ds", "", {"3D Studio", "assimp export a.3ds a.glb"}},
        {"a.lwo", "", {"LightWave", "assimp export a.lwo a.glb"}},
        {"a.dxf", "", {"DXF", "assimp export a.dxf a.glb"}},
        {"a.ifc", "", {"IFC", "assimp export a.ifc a.glb"}},
        {"a.off", "", {"OFF", "assimp export a.off a.glb"}},
        {"off.ply", "OFF\n3 1 0\n", {"OFF", "assimp export off.ply off.glb"}},
        {"a.xml", "<?xml version=\"1.0\"?>\n<amf unit=\"mm\">", {"AMF", "assimp export a.xml a.glb"}},
        {"a.X3D", "", {"X3D", "assimp export a.X3D a.glb"}},
        {"b.xyz", threeMf, {"3MF", "assimp export b.xyz b.glb"}},
        {"a.json", "#usda 1.0\n", {"USD", "usd_import", "-- a.json a.glb"}},
        {"a.usdz", "", {"USD", "usd_import", "-- a.usdz a.glb"}},
        {"usd.stl", usdz, {"USD", "-- usd.stl usd.glb"}},
        {"c.usdc", "PXR-USDC", {"USD", "-- c.usdc c.glb"}},
        {"a.abc", "Ogawa", {"Alembic", "alembic_import", "-- a.abc a.glb"}},
        {"b.blend", "", {"a Blender file", "blender -b b.blend", "-- b.glb"}},
        {"b.ply", "BLENDER-v303", {"a Blender file", "blender -b b.ply"}},
    };
    for (const auto &[name, content, parts] : files) {
        store(name, content);
        expectFailure("render '" + name + "' -o o.png", 3, parts);
    }
    store("scene.json", R"({"meshes": [{"file": "a.fbx"}]})");
    expectFailure("render scene.json -o o.png", 3, {"a.fbx: it is FBX", "assimp export"});
}

} // namespace
} // namespace hyalite::core::testing
