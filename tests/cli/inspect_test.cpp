// The inspect command: what a scene or mesh is made of, and whether its tree finds what brute force finds.
#include "tests/cli/command_line.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace hyalite::core::testing {
namespace {

class InspectCommand : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        store("sheet.obj", wavySheetObj(12));
        store("sheet.json", wavySheetScene());
    }

    /// Expects success and silence on standard error. Returns what was printed.
    [[nodiscard]] std::string inspect(const std::string &line) const {
        const Outcome outcome = run("inspect " + line);
        EXPECT_EQ(outcome.exitCode, 0) << line << '\n' << outcome;
        EXPECT_EQ(outcome.errors, "") << line;
        return outcome.output;
    }
};

/// The first number after the pattern, a regular expression.
long numberAfter(const std::string &text, const std::string &pattern) {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(pattern + "\\s*([0-9]+)"))) {
        ADD_FAILURE() << "no number after \"" << pattern << "\" in:\n" << text;
        return -1;
    }
    return std::stol(match[1]);
}

/// The first line that begins so.
std::string lineOf(const std::string &text, const std::string &begin) {
    const std::size_t at = text.find("\n" + begin);
    return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

TEST_F(InspectCommand, ASceneIsCounted) {
    const std::string text = inspect("sheet.json");
    for (const char *part :
         {"sheet.json", "288 triangles", "2 spheres", "3 materials", "sheet.obj", "midpoint"})
        EXPECT_TRUE(contains(text, part)) << part << '\n' << text;
    EXPECT_EQ(entries(), (std::set<std::string>{"sheet.json", "sheet.obj"})) << "inspect writes no file";
}

TEST_F(InspectCommand, ShippedScenesAreFoundByName) {
    EXPECT_TRUE(contains(inspect("spheres"), "10 spheres"));
    EXPECT_TRUE(contains(inspect("spheres-nested"), "13 spheres"));
    EXPECT_GE(numberAfter(inspect("cat"), "contents"), 144'000);
}

TEST_F(InspectCommand, ATreeIsMeasured) {
    const std::string text = inspect("sheet.obj --bvh sah --leaf-size 3");
    const long inner = numberAfter(text, "nodes");
    std::smatch leaves;
    ASSERT_TRUE(std::regex_search(text, leaves, std::regex("([0-9]+) leaves"))) << text;
    EXPECT_EQ(std::stol(leaves[1]), inner + 1) << "a binary tree";
    EXPECT_LE(numberAfter(text, "largest"), 3);
    EXPECT_GE(numberAfter(text, "depth"), 7) << "288 triangles in leaves of 3 need 7 levels at least";
    for (const char *part : {"sah", "leaf size 3", "SAH cost", "bytes", " s to load", " s to build"})
        EXPECT_TRUE(contains(text, part)) << part << '\n' << text;
}

TEST_F(InspectCommand, BothBuildersObeyTheLeafSize) {
    for (const char *tree : {"midpoint", "sah"})
        for (const int leafSize : {1, 8, 64})
            EXPECT_LE(numberAfter(inspect("sheet.obj --bvh " + std::string(tree) + " --leaf-size " +
                                          std::to_string(leafSize)),
                                  "largest"),
                      leafSize)
                << tree;
}

TEST_F(InspectCommand, AMeshIsCountedWithWhatWasRepairedAndDropped) {
    store("odd.obj", "mtllib missing.mtl\no thing\n"
                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n"
                     "vn 0 0 0\n"
                     "g a\nusemtl m\n"
                     "f 1 2 3 4\n"           // a polygon: two triangles
                     "f 1 2 5\n"             // no area
                     "f -5//1 -4//1 -3//1\n" // a normal that has no direction
    );
    const Outcome outcome = run("inspect odd.obj");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(
        contains(outcome.errors, "hyalite: warning: odd.obj: there is no material library \"missing.mtl\""));
    const std::string &text = outcome.output;
    EXPECT_TRUE(contains(text, "3 triangles")) << text;
    EXPECT_EQ(numberAfter(text, "faces"), 3) << text;
    EXPECT_TRUE(contains(text, "1 of them polygons")) << text;
    EXPECT_EQ(numberAfter(text, "dropped"), 1) << text;
    EXPECT_EQ(numberAfter(text, "repaired"), 1) << text;
}

TEST_F(InspectCommand, TrianglesThatAreThereAgainAreDroppedAndCounted) {
    std::string text = squareObj();
    const std::string faces = text.substr(text.find("\nf "));
    for (int i = 0; i < 500; ++i)
        text += faces;
    store("again.obj", text);
    store("square.obj", squareObj());
    const long count = numberAfter(inspect("square.obj"), "contents");
    for (const char *tree : {"none", "midpoint", "sah"}) {
        const std::string line = "again.obj --rays 50 --bvh " + std::string(tree);
        const std::string inspected = inspect(line);
        EXPECT_EQ(numberAfter(inspected, "contents"), 501 * count);
        EXPECT_EQ(numberAfter(inspected, "histogram[^a-z]*dropped"), 500 * count) << inspected;
        EXPECT_TRUE(contains(inspected, "0 of 50 differ")) << inspected;
    }
    EXPECT_EQ(renderPfm("again.obj --width 16 --height 16 --spp 4 --integrator id"),
              renderPfm("square.obj --width 16 --height 16 --spp 4 --integrator id"));
}

TEST_F(InspectCommand, TrianglesThatLieOnEachOtherAreWarnedOf) {
    std::string text;
    for (int i = 0; i < 3000; ++i)
        text += "v 0 0 0." + std::to_string(10000 + i) + "\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
    store("pile.obj", text);
    const Outcome outcome = run("inspect pile.obj");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_GT(numberAfter(outcome.errors, "warning: .*3000 triangles overlap.*a ray tests about"), 1000)
        << outcome;
    EXPECT_EQ(run("inspect pile.obj --bvh none").errors, "") << "there, that is what was asked for";
}

TEST_F(InspectCommand, SaysWhatASceneIsMadeOf) {
    store("parts.json",
          R"({ "camera": { "position": [0, 0, 9], "target": [0, 0, 0], "width": 64, "height": 48 },
  "background": [0.5, 0.25, 1],
  "materials": { "paper": { "type": "diffuse" }, "lamp": { "type": "diffuse", "emission": 3 }, "spare": { "type": "mirror" } },
  "lights": [ { "type": "spot", "position": [1, 2, 3], "power": 7 }, { "type": "directional", "irradiance": [1, 2, 3] } ],
  "spheres": [ { "centre": [0, 0, 0], "radius": 2, "material": "paper" } ],
  "shapes": [ { "type": "quad", "material": "lamp", "instances": [ [ { "translate": [0, 5, 0] } ], [ { "translate": [0, 7, 0] } ] ] },
              { "type": "box", "material": "paper" } ] })");
    const std::string text = inspect("parts.json");
    for (const char *part :
         {"bounds       (-2, -2, -2) to (2, 8, 2)",
          "camera       perspective at (0, 0, 9), looks along (0, 0, -9)", "64x48 pixels",
          "light        spot at (1, 2, 3) along (0, -1, 0), 30 degrees, power 7",
          "light        directional along (0, -1, 0), irradiance (1, 2, 3)",
          "emitter      \"lamp\": 4 triangles of radiance 3", "background   (0.5, 0.25, 1)",
          "material     \"paper\": diffuse, on 1 sphere and 12 triangles",
          "material     \"spare\": mirror, on nothing", "shapes       box x 1"})
        EXPECT_TRUE(contains(text, part)) << part << '\n' << text;
}

TEST_F(InspectCommand, AMeshWhoseUpIsZStands) {
    const std::string standing = inspect("sheet.obj --up z");
    EXPECT_TRUE(contains(standing, "up is (0, 0, 1)")) << standing;
    EXPECT_EQ(standing.substr(0, standing.find("time")),
              inspect("sheet.obj --up 0,0,1").substr(0, standing.find("time")));
    EXPECT_TRUE(contains(inspect("sheet.obj --up -y"), "up is (0, -1, 0)"));
    EXPECT_NE(lineOf(standing, "light "), lineOf(inspect("sheet.obj"), "light "));
    EXPECT_NE(lineOf(inspect("sheet.obj --camera-position 0,0,-9"), "light "),
              lineOf(inspect("sheet.obj"), "light "))
        << "lights follow the camera";
    expectFailure("inspect sheet.obj --up w", 2, {"--up: found \"w\"", "x, y, z, -x, -y or -z"});
}

TEST_F(InspectCommand, RaysFindTheSameByTreeAndByBruteForce) {
    for (const char *line : {"sheet.json --rays 500", "sheet.obj --rays 500 --bvh sah --leaf-size 1",
                             "sheet.obj --rays 1 --bvh none"}) {
        const std::string text = inspect(line);
        EXPECT_TRUE(std::regex_search(text, std::regex("0 of [0-9]+ differ"))) << text;
        EXPECT_TRUE(contains(text, "us a ray")) << text;
    }
}

TEST_F(InspectCommand, JsonSaysWhatTheTextSays) {
    store("parts.json",
          R"({ "camera": { "position": [0, 0, 9], "target": [0, 0, 0], "width": 64, "height": 48 },
  "materials": { "paper": { "type": "diffuse" }, "lamp": { "type": "diffuse", "emission": 3 } },
  "lights": [ { "type": "spot", "position": [1, 2, 3], "power": 7 }, { "type": "directional", "irradiance": [1, 2, 3] } ],
  "spheres": [ { "centre": [0, 0, 0], "radius": 2, "material": "paper" } ],
  "meshes": [ { "file": "sheet.obj", "material": "paper" } ],
  "shapes": [ { "type": "quad", "material": "lamp", "transform": [ { "translate": [0, 5, 0] } ] } ] })");
    const nlohmann::json json = nlohmann::json::parse(inspect("parts.json --json --rays 20"));
    EXPECT_EQ(json.at("inspectVersion"), 2);
    EXPECT_TRUE(contains(json.at("program"), "hyalite "));
    EXPECT_TRUE(contains(json.at("commandLine"), "inspect parts.json --json"));
    EXPECT_EQ(json.at("inputFiles"), (std::vector<std::string>{"parts.json", "sheet.obj"}));
    EXPECT_EQ(json.at("contents").at("triangles"), 290);
    EXPECT_EQ(json.at("contents").at("spheres"), 1);
    EXPECT_EQ(json.at("bounds"), nlohmann::json::parse(R"({"low": [-2, -2, -2], "high": [2, 6, 2]})"));
    EXPECT_EQ(json.at("camera").at("type"), "perspective");
    EXPECT_EQ(json.at("camera").at("position"), (std::vector<double>{0, 0, 9}));
    EXPECT_EQ(json.at("camera").at("width"), 64);
    EXPECT_EQ(json.at("lights").at(0).at("power"), (std::vector<double>{7, 7, 7}));
    EXPECT_EQ(json.at("lights").at(1).at("irradiance"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(json.at("materials").at(0).at("name"), "lamp");
    EXPECT_EQ(json.at("materials").at(0).at("emission"), (std::vector<double>{3, 3, 3}));
    EXPECT_EQ(json.at("materials").at(0).at("triangles"), 2);
    EXPECT_EQ(json.at("shapes"), nlohmann::json::parse(R"({"quad": 1})"));
    EXPECT_EQ(json.at("nodes").size(), 2u);
    EXPECT_EQ(json.at("nodes").at(0).at("kind"), "shape");
    EXPECT_EQ(json.at("nodes").at(1).at("name"), "sheet.obj");
    EXPECT_EQ(json.at("nodes").at(0).at("bounds").at("low").at(1), 4);
    EXPECT_EQ(json.at("meshes").at(0).at("triangles"), 288);
    EXPECT_EQ(json.at("settings").at("integrator"), "path");
    EXPECT_EQ(json.at("tree").at("type"), "midpoint");
    EXPECT_TRUE(json.at("tree").at("fault").is_null());
    EXPECT_EQ(json.at("rays").at("differences"), 0);
    EXPECT_GT(json.at("bytes").at("scene"), 0);
    EXPECT_FALSE(json.contains("coverage"));
    expectFailure("inspect nonesuch.json --json", 3, {"nonesuch.json"});
}

TEST_F(InspectCommand, JsonHasTheListsOfAGltfFile) {
    GltfMaker maker = oneTriangle();
    maker.json["meshes"][0]["name"] = "lid";
    const std::size_t times = maker.addScalars({0, 2.5});
    maker.json["accessors"][times]["max"] = {2.5};
    maker.json["animations"] = {{{"name", "spin\u001b"},
                                 {"samplers", {{{"input", times}, {"output", 0}}}},
                                 {"channels", nlohmann::json::array()}}};
    maker.json["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    maker.json["nodes"] = {{{"name", "pot"}, {"children", {1, 2}}},
                           {{"mesh", 0}, {"translation", {0, 0, 3}}},
                           {{"camera", 0}, {"translation", {0, 0, 5}}}};
    store("pot.glb", maker.glb());
    const nlohmann::json json = nlohmann::json::parse(inspect("pot.glb --json --coverage"));
    EXPECT_EQ(json.at("gltf").at("cameras").at(0).at("name"), "eye");
    EXPECT_EQ(json.at("gltf").at("animations").at(0).at("seconds"), 2.5);
    EXPECT_EQ(json.at("gltf").at("nodeCount"), 3);
    const nlohmann::json &nodes = json.at("nodes");
    ASSERT_EQ(nodes.size(), 2u) << "those with a mesh at or below them";
    EXPECT_EQ(nodes.at(0).at("name"), "pot");
    EXPECT_EQ(nodes.at(0).at("bounds"), nodes.at(1).at("bounds"));
    EXPECT_EQ(nodes.at(1).at("mesh"), "lid");
    EXPECT_EQ(nodes.at(1).at("parent"), 0);
    EXPECT_EQ(nodes.at(1).at("bounds").at("low"), (std::vector<double>{0, 0, 3}));
    const nlohmann::json &seen = json.at("coverage").at("objects").at(0);
    EXPECT_EQ(seen.at("kind"), "node");
    EXPECT_EQ(seen.at("index"), 1);
    EXPECT_EQ(seen.at("mesh"), "lid");
    EXPECT_GT(seen.at("share"), 0.01);
}

TEST_F(InspectCommand, CoverageSaysWhatFillsThePicture) {
    const std::string text = inspect("sheet.json --coverage");
    for (const char *part : {"% of ", "pixels see the background\n", "% mesh sheet.obj, at x ",
                             "% sphere 0 of \"", "  material "})
        EXPECT_TRUE(contains(text, part)) << part << '\n' << text;
    const nlohmann::json coverage =
        nlohmann::json::parse(inspect("sheet.json --coverage --json")).at("coverage");
    double sum = coverage.at("background");
    for (const nlohmann::json &object : coverage.at("objects"))
        sum += object.at("share").get<double>();
    EXPECT_NEAR(sum, 1.0, 1e-12);
    double worn = coverage.at("background");
    for (const nlohmann::json &material : coverage.at("materials"))
        worn += material.at("share").get<double>();
    EXPECT_NEAR(worn, 1.0, 1e-12);
    EXPECT_TRUE(contains(inspect("sheet.json --coverage --camera-position 0,0,90 --look-at 0,0,900"),
                         "coverage     100.00 % of"));
}

TEST_F(InspectCommand, WhatThereIsOneOfIsInTheSingular) {
    const std::string text = inspect("sheet.json");
    for (const char *part : {"in 1 mesh,", "1 light,", "2 spheres", "3 materials"})
        EXPECT_TRUE(contains(text, part)) << part << '\n' << text;
}

TEST_F(InspectCommand, WithoutATreeNothingIsSaidOfOne) {
    const std::string spheres = inspect("spheres --rays 10");
    for (const char *part : {"tree", "leaves", "SAH"})
        EXPECT_FALSE(contains(spheres, part)) << part << '\n' << spheres;
    EXPECT_TRUE(contains(spheres, "bytes")) << spheres;
    EXPECT_FALSE(contains(inspect("sheet.obj --rays 10 --bvh none"), "times as fast"));
    EXPECT_TRUE(contains(inspect("sheet.obj --rays 10"), "times as fast"));
}

TEST_F(InspectCommand, OnTheCatTheTreeIsOverAHundredTimesFaster) {
    EXPECT_GT(numberAfter(inspect("cat --rays 200"), "the tree is"), 100);
}

TEST_F(InspectCommand, WhatCannotBeReadIsBadInput) {
    store("bad.obj", "v 0 0 0\nf 1 2 3\n");
    expectFailure("inspect bad.obj", 3, {"bad.obj:2", "2"});
    expectFailure("inspect nonesuch.json", 3, {"nonesuch.json"});
    expectFailure("inspect nonesuch", 3, {"nonesuch", "spheres"});
    expectFailure("inspect", 2, {"scene"});
    expectFailure("inspect sheet.obj --rays 0", 2, {"--rays", "1", "1000000"});
    expectFailure("inspect sheet.obj --leaf-size 0", 2, {"--leaf-size", "1", "64"});
}

} // namespace
} // namespace hyalite::core::testing
