// SCENE: a path, a shipped scene's name or a bare mesh; and what is said where it cannot be used.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

using SceneArgument = CommandLine;

const std::string smallScene = " --width 16 --height 12 --spp 1 --device cpu";

TEST_F(SceneArgument, IsAPathOrAName) {
    const std::string byName = renderPfm("spheres" + smallScene);
    EXPECT_EQ(renderPfm("'" HYALITE_ASSET_DIR "/scenes/spheres.json'" + smallScene), byName);
    EXPECT_EQ(renderPfm("'" HYALITE_SOURCE_DIR "/assets/scenes/spheres.json'" + smallScene), byName);
    fs::copy_file(HYALITE_ASSET_DIR "/scenes/spheres.json", folder / "Copy.JSON");
    EXPECT_EQ(renderPfm("Copy.JSON" + smallScene), byName);
    EXPECT_EQ(renderPfm("./Copy.JSON" + smallScene), byName);
}

TEST_F(SceneArgument, MayStandBehindTheOptions) {
    const std::string wanted = renderPfm("spheres" + smallScene);
    ASSERT_EQ(run("render --quiet -o a.pfm --width 16 --height 12 --spp 1 --device cpu spheres").exitCode, 0);
    EXPECT_EQ(load("a.pfm"), wanted);
    ASSERT_EQ(run("render --crop 0,16,0,12 -o a.pfm" + smallScene + " -- spheres").exitCode, 0);
    EXPECT_EQ(load("a.pfm"), wanted);
}

TEST_F(SceneArgument, EveryShippedSceneRenders) {
    for (const char *scene : {"spheres", "spheres-nested", "cat"})
        EXPECT_GT(litPixelCount(renderImage(scene + smallScene)), 16 * 12 / 2) << scene;
}

TEST_F(SceneArgument, NamesAreResolvedInTheVariablesFolderFirst) {
    fs::create_directories(folder / "own/scenes");
    store("own/scenes/spheres.json", R"({"background": 0.5})");
    store("own/scenes/mine.json", R"({"background": 0.5})");
    Surroundings surroundings;
    surroundings.environment["HYALITE_ASSETS"] = (folder / "own").string();
    ASSERT_EQ(runIn(surroundings, "render spheres -o shadowed.pfm" + smallScene).exitCode, 0);
    ASSERT_EQ(runIn(surroundings, "render mine -o mine.pfm" + smallScene).exitCode, 0);
    EXPECT_EQ(load("shadowed.pfm"), load("mine.pfm"));
    // What is not there is looked for beside the program.
    EXPECT_EQ(runIn(surroundings, "render spheres-nested -o nested.pfm" + smallScene).exitCode, 0);
    surroundings.environment["HYALITE_ASSETS"] = "own";
    EXPECT_EQ(runIn(surroundings, "render mine -o relative.pfm" + smallScene).exitCode, 0);
}

TEST_F(SceneArgument, NamesAreResolvedBesideTheProgram) {
    const std::string wanted = renderPfm("spheres" + smallScene);
    Surroundings surroundings;
    for (const std::optional<std::string> &value :
         {std::optional<std::string>(), std::optional<std::string>("")}) {
        surroundings.environment["HYALITE_ASSETS"] = value;
        const Outcome outcome = runIn(surroundings, "render spheres -o a.pfm" + smallScene);
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_EQ(load("a.pfm"), wanted);
    }
}

TEST_F(SceneArgument, AnUnknownNameIsAnsweredWithTheNamesThereAre) {
    expectFailure("render sphere -o a.png", 3, {"sphere\"", "cat", "spheres", "spheres-nested"});
    expectFailure("render Spheres -o a.png", 3, {"Spheres", "spheres-nested"});
    for (const char *wrong : {"a.txt", "a/b", ".", "''", "spheres.json.gz"})
        expectFailure(std::string("render ") + wrong + " -o a.png", 3, {".json", ".obj", "spheres"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(SceneArgument, AMissingFileIsNamed) {
    expectFailure("render nonesuch.json -o a.png", 3, {"nonesuch.json"});
    expectFailure("render no/such.obj -o a.png", 3, {"no/such.obj: there is no such file"});
    // With an extension it is a path, not the name of a shipped scene.
    expectFailure("render spheres.json -o a.png", 3,
                  {"spheres.json: there is no such file", "did you mean the shipped scene spheres?"});
    fs::create_directory(folder / "folder.json");
    expectFailure("render folder.json -o a.png", 3, {"folder.json"});
}

struct WrongScene {
    const char *text;
    std::vector<std::string> parts; ///< what the message contains beside the file's name
};

TEST_F(SceneArgument, FaultsInASceneFileAreNamedWithFileAndKey) {
    const std::vector<WrongScene> cases{
        {"", {":1:1"}},
        {"{\n  \"camera\": {},\n}", {":3:"}},
        {"[]", {"array"}},
        {R"({"camera": {"positon": [0, 0, 1]}})", {"/camera/positon", "position"}},
        {R"({"camera": {"position": [0, 1]}})", {"/camera/position", "3"}},
        {R"({"camera": {"width": 0}})", {"/camera/width", "0", "1", "32768"}},
        {R"({"camera": {"width": "wide"}})", {"/camera/width", "wide"}},
        {R"({"camera": {"direction": [0, 1, 0]}})", {"camera", "up"}},
        {R"({"settings": {"bvh": "fast"}})", {"/settings/bvh", "fast", "midpoint", "sah", "none"}},
        {R"({"lights": [{"type": "point", "position": [0, 0, 0]}]})", {"/lights/0", "power"}},
        {R"({"spheres": [{"centre": [0, 0, 0], "radius": 1, "material": "m"}]})",
         {"/spheres/0/material", "m"}},
        {R"({"materials": {"m": {"type": "mirror"}},
             "spheres": [{"centre": [0, 0, 0], "radius": -1, "material": "m"}]})",
         {"/spheres/0/radius", "-1"}},
        {R"({"materials": {"m": {"type": "mirror"}}, "meshes": [{"file": "no.obj", "material": "m"}]})",
         {"/meshes/0/file", "no.obj: there is no such file"}},
    };
    for (const WrongScene &wrong : cases) {
        store("wrong.json", wrong.text);
        std::vector<std::string> parts = wrong.parts;
        parts.emplace_back("wrong.json");
        expectFailure("render wrong.json -o a.png", 3, parts);
        expectFailure("inspect wrong.json", 3, parts);
    }
    EXPECT_EQ(entries(), std::set<std::string>{"wrong.json"});
}

TEST_F(SceneArgument, MoreSpheresThanAreTestedDirectlyAreRendered) {
    std::string text = R"({"materials": {"m": {"type": "mirror"}}, "spheres": [)";
    for (int i = 0; i < 65; ++i)
        text += std::string(i > 0 ? "," : "") + R"({"centre": [0, 0, 0], "radius": 1, "material": "m"})";
    store("many.json", text + "]}");
    EXPECT_EQ(litPixelCount(renderImage("many.json" + smallScene)), 0); // mirrors of the dark
}

TEST_F(SceneArgument, MeshesAreFoundBesideTheSceneFile) {
    fs::create_directories(folder / "deep/down");
    store("deep/sheet.json",
          wavySheetScene().replace(wavySheetScene().find("sheet.obj"), 9, "down/sheet.obj"));
    store("deep/down/sheet.obj", wavySheetObj(4));
    EXPECT_GT(litPixelCount(renderImage("deep/sheet.json" + smallScene)), 0);
}

TEST_F(SceneArgument, AnEmptySceneIsBlack) {
    store("empty.json", "{}");
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const Image image = renderImage("empty.json --width 16 --height 12 --spp 1 --device " + device);
        EXPECT_EQ(image.pixels().size(), 192u);
        EXPECT_EQ(litPixelCount(image), 0);
    }
}

TEST_F(SceneArgument, ACameraInsideGlassIsRenderedAlikeOnDeviceAndCpu) {
    const std::string line = "spheres --width 16 --height 12 --spp 2 --camera-position 0,0,3 --device ";
    const std::string wanted = renderPfm(line + "cpu");
    EXPECT_EQ(renderPfm(line + softwareDevice()), wanted);
    EXPECT_GT(litPixelCount(renderImage(line + "cpu")), 0);
}

/// A house with a concave front, quads, and corners in the three notations.
const char *const house = "# corners: the front, then the back\n"
                          "v 0 0 1\nv 4 0 1\nv 4 3 1\nv 2 1.5 1\nv 0 3 1\n"
                          "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 2 1.5 0\nv 0 3 0\n"
                          "vt 0 0\nvn 0 0 1\n"
                          "f 1//1 2//1 3//1 4//1 5//1\n"
                          "f 10 9 8 7 6\n"
                          "f 1/1 6/1 7/1 2/1\n"
                          "f 2 7 8 3\nf 3 8 9 4\nf 4 9 10 5\nf -6 -1 -5 -10\n";

TEST_F(SceneArgument, ABareMeshIsFramedAndLit) {
    store("house.obj", house);
    for (const char *size : {"48 --height 36", "120 --height 30", "30 --height 120"}) {
        const Image image = renderImage(std::string("house.obj --spp 4 --device cpu --width ") + size);
        ASSERT_GT(image.width(), 0);
        const glm::vec3 background = image.at(0, 0);
        int meshPixelCount = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) {
                const bool isMesh = image.at(x, y) != background;
                const bool isBorder = x == 0 || y == 0 || x == image.width() - 1 || y == image.height() - 1;
                EXPECT_FALSE(isMesh && isBorder) << size << ": cut off at " << x << ", " << y;
                meshPixelCount += isMesh ? 1 : 0;
            }
        const int side = std::min(image.width(), image.height());
        EXPECT_GT(meshPixelCount, side * side / 5) << size;
        float brightest = 0.0f;
        for (const glm::vec3 &pixel : image.pixels())
            brightest = std::max(brightest, pixel.x);
        EXPECT_GT(brightest, 0.2f) << size;
        EXPECT_LT(brightest, 1.2f) << size;
    }
}

TEST_F(SceneArgument, ABareMeshIsRenderedAlikeOnDeviceAndCpu) {
    store("house.obj", house);
    EXPECT_EQ(renderPfm("house.obj" + smallScene),
              renderPfm("house.obj --width 16 --height 12 --spp 1 --device " + softwareDevice()));
}

TEST_F(SceneArgument, ABareMeshMayBeTinyOrHuge) {
    for (const char *scale : {"e-6", "e8"}) {
        const std::string s = scale;
        store("scaled.obj",
              "v 0 0 0\nv 4" + s + " 0 0\nv 4" + s + " 3" + s + " 0\nv 0 3" + s + " 1" + s + "\nf 1 2 3 4\n");
        const Image image = renderImage("scaled.obj" + smallScene);
        ASSERT_EQ(image.width(), 16);
        EXPECT_NE(image.at(8, 6), image.at(0, 0)) << scale;
    }
}

TEST_F(SceneArgument, FaultsInAMeshAreNamedWithFileAndLine) {
    const std::vector<WrongScene> cases{
        {"", {"no triangle"}},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", {":4", "9", "3"}},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", {":4", "-4"}},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", {":4", "0"}},
        {"v 0 0 x\n", {":1"}},
        {"v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {":1"}},
        {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", {"no triangle", "1"}},
    };
    for (const WrongScene &wrong : cases) {
        store("wrong.obj", wrong.text);
        std::vector<std::string> parts = wrong.parts;
        parts.emplace_back("wrong.obj");
        expectFailure("render wrong.obj -o a.png", 3, parts);
    }
    EXPECT_EQ(entries(), std::set<std::string>{"wrong.obj"});
}

} // namespace
} // namespace hyalite::core::testing
