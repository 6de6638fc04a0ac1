// `hyalite new`: a scene to start from.
#include "tests/cli/command_line.h"

#include "host/image/image_file.h"

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
