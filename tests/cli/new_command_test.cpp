// `hyalite new`: a scene to start from.
#include "tests/cli/command_line.h"

#include "host/image/image_file.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace hyalite::core::testing {
namespace {

using NewScene = CommandLine;

TEST_F(NewScene, IsWrittenAndRendered) {
    const Outcome outcome = run("new 'my scene.json'");
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(outcome.errors, "");
    EXPECT_TRUE(contains(outcome.output, "hyalite render 'my scene.json' -o first.png --tone agx"))
        << outcome;
    const nlohmann::json scene = nlohmann::json::parse(load("my scene.json"));
    EXPECT_EQ(scene.at("shapes").size() + scene.at("spheres").size(), 5u) << "a floor, three objects, a lamp";
    for (const auto &shape : scene.at("shapes"))
        EXPECT_TRUE(shape.contains("description"));
    const Outcome rendered =
        run("render 'my scene.json' -o a.pfm --width 64 --height 40 --spp 16 --device cpu --quiet");
    EXPECT_EQ(rendered.exitCode, 0) << rendered;
    EXPECT_EQ(rendered.errors, "") << "no warnings";
    const Image image = readImage(folder / "a.pfm").image;
    double mean = 0.0;
    for (const glm::vec3 &pixel : image.pixels())
        mean += static_cast<double>(pixel.x + pixel.y + pixel.z) / 3.0;
    mean /= static_cast<double>(image.pixels().size());
    EXPECT_GT(mean, 0.15) << "neither dark";
    EXPECT_LT(mean, 0.8) << "nor bleached";
    EXPECT_EQ(litPixelCount(image), 64 * 40);
}

/// Shares of the picture, by the names of objects.
double shareOf(const nlohmann::json &inspected, const std::string &name) {
    double share = 0.0;
    for (const nlohmann::json &object : inspected.at("coverage").at("objects"))
        if (object.at("name") == name || object.value("file", "") == name)
            share += object.at("share").get<double>();
    return share;
}

/// A tower of side 1 around (7, 9) that stands at z = 100 and is 3 high.
std::string towerObj() {
    std::string text;
    for (int corner = 0; corner < 8; ++corner)
        text += fmt::format("v {} {} {}\n", (corner & 1) != 0 ? 7.5 : 6.5, (corner & 2) != 0 ? 9.5 : 8.5,
                            (corner & 4) != 0 ? 103 : 100);
    return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

TEST_F(NewScene, OfAModelShowsItStandingInTheLight) {
    std::filesystem::create_directories(folder / "models");
    store("models/tower.obj", towerObj());
    const Outcome outcome = run("new --from models/tower.obj --up z tower.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "hyalite render tower.json -o model.png")) << outcome;
    const nlohmann::json scene = nlohmann::json::parse(load("tower.json"));
    EXPECT_EQ(scene.at("meshes").at(0).at("file"), "models/tower.obj");
    const nlohmann::json seen = nlohmann::json::parse(run("inspect tower.json --json --coverage").output);
    for (const nlohmann::json &node : seen.at("nodes"))
        if (node.at("kind") == "mesh")
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(node.at("bounds").at("low").at(static_cast<std::size_t>(axis)).get<double>(),
                            axis == 1 ? 0.0 : -0.5, 1e-5);
                EXPECT_NEAR(node.at("bounds").at("high").at(static_cast<std::size_t>(axis)).get<double>(),
                            axis == 1 ? 3.0 : 0.5, 1e-5);
            }
    EXPECT_GT(shareOf(seen, "models/tower.obj"), 0.08);
    EXPECT_LT(shareOf(seen, "models/tower.obj"), 0.5);
    EXPECT_GT(shareOf(seen, "quad"), 0.4) << "the floor";
    for (const nlohmann::json &object : seen.at("coverage").at("objects"))
        if (object.at("kind") == "mesh") {
            const nlohmann::json &box = object.at("box");
            EXPECT_GT(box.at(0), 0) << "all of it is in the picture";
            EXPECT_LT(box.at(1), 640);
            EXPECT_GT(box.at(2), 0);
            EXPECT_LT(box.at(3), 480);
        } else {
            EXPECT_EQ(object.at("index"), 0) << "the lamp is outside";
        }
    const Image image = renderImage("tower.json --width 64 --height 48 --spp 16 --device cpu");
    const auto *const pixels = image.pixels().data();
    EXPECT_GT(pixels[64 * 24 + 30].y, 0.2f) << "the tower is lit";
    EXPECT_LT(pixels[64 * 24 + 30].y, 1.2f) << "and not bleached";
    EXPECT_GT(pixels[64 * 44 + 8].y, 0.15f) << "the floor, too";
}

TEST_F(NewScene, OfModelsOfAnySizeAndFormatAreRead) {
    GltfMaker maker = oneTriangle();
    maker.json["nodes"][0]["scale"] = {1e-4, 1e-4, 1e-4};
    store("small.glb", maker.glb());
    store("large.obj", "v 0 0 0\nv 3e7 0 0\nv 0 4e7 1e7\nf 1 2 3\n");
    store("far.stl",
          "solid a\nfacet normal 0 0 1\nouter loop\nvertex 500000 4000000 20\nvertex 500003 4000000 20\n"
          "vertex 500000 4000002 21\nendloop\nendfacet\nendsolid a\n");
    for (const std::string name : {"small.glb", "large.obj", "far.stl"}) {
        ASSERT_EQ(run("new --from " + name + " " + name + ".json").exitCode, 0) << name;
        const Outcome outcome = run("inspect " + name + ".json --json --coverage");
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_EQ(outcome.errors, "") << name;
        EXPECT_GT(shareOf(nlohmann::json::parse(outcome.output), name), 0.02) << name;
    }
}

TEST_F(NewScene, OfAModelOutOfReachIsRefused) {
    std::filesystem::create_directories(folder / "scenes");
    store("tower.obj", towerObj());
    store("scenes/bad.obj", "v 0 0 0\nf 1 2 3\n");
    expectFailure("new --from tower.obj scenes/a.json", 2,
                  {"tower.obj is not in the folder of scenes/a.json"});
    std::filesystem::create_symlink("../tower.obj", folder / "scenes/link.obj");
    expectFailure("new --from scenes/link.obj scenes/a.json", 2, {"is not in the folder"});
    expectFailure("new --from nonesuch.obj a.json", 3, {"nonesuch.obj"});
    expectFailure("new --from scenes/bad.obj a.json", 3, {"bad.obj:2"});
    expectFailure("new --from tower.obj missing/a.json", 7, {"missing/a.json: No such file"});
    expectFailure("new --from - a.json", 2, {"standard input"});
    expectFailure("new --from a.json b.json", 2, {"is a scene itself"});
    expectFailure("new --up z a.json", 2, {"--up needs --from"});
    expectFailure("new --from tower.obj --up w a.json", 2, {"--up: found \"w\"", "\"-z\""});
    EXPECT_FALSE(std::filesystem::exists(folder / "scenes/a.json"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.json"));
}

TEST_F(NewScene, NeverReplacesAFile) {
    store("mine.json", "mine");
    expectFailure("new mine.json", 7, {"mine.json: exists already, and is left as it is"});
    EXPECT_EQ(load("mine.json"), "mine");
    std::filesystem::create_symlink("nowhere.json", folder / "link.json");
    expectFailure("new link.json", 7, {"exists already"});
    EXPECT_FALSE(std::filesystem::exists(folder / "nowhere.json"));
}

TEST_F(NewScene, IsNamedAsScenesAre) {
    expectFailure("new scene.txt", 2, {"ends in .json", "scene.txt.json"});
    expectFailure("new missing/scene.json", 7, {"missing/scene.json: No such file or directory"});
    expectFailure("new", 2, {"file"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

} // namespace
} // namespace hyalite::core::testing
