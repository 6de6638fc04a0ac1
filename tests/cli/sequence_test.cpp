// Sequences: frames of a moving camera are the pictures that one would render one by one; they resume, and machines
// share them.
#include "host/base/error.h"
#include "host/jobs/sequence.h"
#include "tests/cli/command_line.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hyalite::core::testing {
namespace {

using SequenceFrames = CommandLine;

const std::string smallFrames = " --width 24 --height 16 --spp 2 --quiet";

/// A ball before grey, whose camera goes straight from z 55 to 45 in ten frames.
std::string movingScene() {
    return R"({"camera": {"position": [0, 0, 55], "path": {"interpolation": "linear", "keys": [
                  {"frame": 0}, {"frame": 10, "position": [0, 0, 45]}]}},
               "background": 0.3, "materials": {"grey": {"type": "diffuse"}},
               "lights": [{"type": "point", "position": [0, 40, 40], "power": 1e5}],
               "spheres": [{"centre": [0, 0, 0], "radius": 10, "material": "grey"}]})";
}

std::set<std::string> withoutScenes(std::set<std::string> names) {
    std::erase_if(names, [](const std::string &name) { return name.ends_with("json"); });
    return names;
}

TEST_F(SequenceFrames, AreThePicturesOfTheirCameras) {
    store("moving.json", movingScene());
    const Outcome outcome = run("render moving.json --frames 3..5 -o f.##.pfm" + smallFrames);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(withoutScenes(entries()), (std::set<std::string>{"f.03.pfm", "f.04.pfm", "f.05.pfm"}));
    for (int frame = 3; frame <= 5; ++frame)
        EXPECT_TRUE(load(nameOfFrame("f.##.pfm", frame, "")) ==
                    renderPfm("moving.json --camera-position 0,0," + std::to_string(55 - frame) +
                              " --width 24 --height 16 --spp 2"))
            << frame;
}

TEST_F(SequenceFrames, OfATurntableAreThePicturesOfTheirCameras) {
    ASSERT_EQ(run("render spheres --turntable 4 -o t.#.pfm" + smallFrames).exitCode, 0);
    EXPECT_TRUE(load("t.0.pfm") == renderPfm("spheres --width 24 --height 16 --spp 2"));
    // The camera at (0, 0, 55) looks at the origin.
    const Image there =
        renderImage("spheres --camera-position -55,0,0 --look-at 0,0,0 --width 24 --height 16 --spp 2");
    const Outcome diff = run("diff t.3.pfm rendered.pfm --min-psnr 50");
    EXPECT_EQ(there.width(), 24);
    EXPECT_EQ(diff.exitCode, 0) << diff;
    EXPECT_FALSE(load("t.1.pfm") == load("t.3.pfm"));
}

TEST_F(SequenceFrames, BeginInTheGlassAroundTheirCameras) {
    // In a block that absorbs, 1.5 before its wall.
    store("block.json", R"({"materials": {"block": {"type": "dielectric", "index": 1, "absorption": 1}},
        "background": 1, "shapes": [{"type": "box", "material": "block"}],
        "camera": {"position": [0, 0, 0.5], "direction": [0, 0, -1], "horizontalFov": 1},
        "settings": {"integrator": "path"}})");
    ASSERT_EQ(run("render block.json --turntable 2 -o t.#.pfm" + smallFrames).exitCode, 0);
    const Image still = renderImage("block.json --width 24 --height 16 --spp 2");
    EXPECT_TRUE(load("t.0.pfm") == load("rendered.pfm"));
    EXPECT_NEAR(still.pixels()[0].x, std::exp(-1.5), 1e-3);
}

TEST_F(SequenceFrames, FollowGltfCamerasAndWhatMovesBesides) {
    GltfMaker maker = oneTriangle();
    const std::size_t input = maker.addScalars({0, 1});
    const std::size_t output = maker.addVec3({0, 0, 5, 1, 0, 5});
    maker.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", input}, {"output", output}}}}}};
    maker.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    maker.json["nodes"].push_back({{"camera", 0}});
    maker.json["scenes"][0]["nodes"] = {0, 1};
    store("camera.glb", maker.glb());
    maker.json["animations"][0]["channels"][0]["target"]["node"] = 0;
    maker.json["nodes"][1]["translation"] = {0.5, 0, 12};
    store("mesh.glb", maker.glb());
    for (const std::string scene : {"camera.glb", "mesh.glb"}) {
        const Outcome outcome = run("render " + scene + " --frames 0..2 --fps 2 -o g.#.pfm" + smallFrames);
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        for (int frame = 0; frame <= 2; ++frame)
            EXPECT_TRUE(load(nameOfFrame("g.#.pfm", frame, "")) ==
                        renderPfm(scene + " --time " + std::to_string(0.5 * frame) +
                                  " --width 24 --height 16 --spp 2"))
                << scene << ", frame " << frame;
    }
}

TEST_F(SequenceFrames, ThatAreMissingOrOtherAreRendered) {
    store("moving.json", movingScene());
    const std::string line = "render moving.json --frames 1..3 -o f.#.exr --width 24 --height 16 --resume";
    ASSERT_EQ(run(line + " --spp 2").exitCode, 0);
    const std::string third = load("f.3.exr");
    std::filesystem::remove(folder / "f.2.exr");
    std::filesystem::permissions(folder / "f.1.exr", std::filesystem::perms::owner_read); // as of an archive
    const Outcome again = run(line + " --spp 2");
    EXPECT_EQ(again.exitCode, 0) << again;
    EXPECT_TRUE(contains(again.output, "f.1.exr: frame 1 is finished\n")) << again;
    EXPECT_TRUE(contains(again.output, "f.2.exr: 24x16, 2 spp")) << again;
    EXPECT_TRUE(load("f.3.exr") == third);
    std::filesystem::permissions(folder / "f.1.exr", std::filesystem::perms::owner_all);
    std::filesystem::resize_file(folder / "f.3.exr", third.size() / 2); // as a copy that was cut short
    EXPECT_TRUE(contains(run(line + " --spp 2").output, "f.3.exr: 24x16, 2 spp"));
    EXPECT_TRUE(load("f.3.exr") == third);
    EXPECT_TRUE(contains(run(line + " --spp 3").output, "f.1.exr: 24x16, 3 spp")); // another picture
}

TEST_F(SequenceFrames, OfAnotherSizeAreNotTakenForFinished) {
    store("moving.json", movingScene());
    const std::string line =
        "render moving.json --frames 1 -o f.#.png --width 24 --height 16 --spp 2 --resume";
    ASSERT_EQ(run(line).exitCode, 0);
    const std::string whole = load("f.1.png");
    ASSERT_EQ(run("render moving.json -o small.png --width 8 --height 8 --spp 1").exitCode, 0);
    const std::string small = load("small.png");
    constexpr std::size_t textsBegin = 8 + 12 + 13; // behind the header
    const std::size_t textsEnd = whole.find("IDAT") - 4;
    store("f.1.png", small.substr(0, textsBegin) + whole.substr(textsBegin, textsEnd - textsBegin) +
                         small.substr(textsBegin));
    EXPECT_TRUE(contains(run(line).output, "f.1.png: 24x16, 2 spp"));
    EXPECT_TRUE(load("f.1.png") == whole);
}

TEST_F(SequenceFrames, ThatArePaintedOverAreNotTakenForFinished) {
    store("moving.json", movingScene());
    const std::string line = "render moving.json --frames 1 --width 24 --height 16 --spp 2 --resume -o f.#.";
    ASSERT_EQ(run(line + "png").exitCode, 0);
    const std::string whole = load("f.1.png");
    ASSERT_EQ(run("render spheres -o other.png --width 24 --height 16 --spp 1").exitCode, 0);
    const std::string other = load("other.png");
    store("f.1.png", whole.substr(0, whole.find("IDAT") - 4) + other.substr(other.find("IDAT") - 4));
    EXPECT_TRUE(contains(run(line + "png").output, "f.1.png: 24x16, 2 spp"));
    EXPECT_TRUE(load("f.1.png") == whole);
    EXPECT_TRUE(contains(run(line + "png").output, "f.1.png: frame 1 is finished"));
    EXPECT_TRUE(contains(run(line + "exr").output, "f.1.exr: 24x16, 2 spp"));
    EXPECT_TRUE(contains(run(line + "exr").output, "f.1.exr: frame 1 is finished"));
}

TEST_F(SequenceFrames, AreDealtToParts) {
    store("moving.json", movingScene());
    for (const char *part : {"1/3", "2/3", "3/3"})
        ASSERT_EQ(run("render moving.json --frames 5..9 -o f.#.pfm --part " + std::string(part) + smallFrames)
                      .exitCode,
                  0);
    EXPECT_EQ(withoutScenes(entries()),
              (std::set<std::string>{"f.5.pfm", "f.6.pfm", "f.7.pfm", "f.8.pfm", "f.9.pfm"}));
    const Outcome none = run("render moving.json --frames 5 -o f.#.pfm --part 2/3");
    EXPECT_EQ(none.exitCode, 0);
    EXPECT_EQ(none.output, "part 2 of 3 has no frame\n");
}

TEST_F(SequenceFrames, ThatAreNotFinishedAreNotWritten) {
    const Outcome outcome = run("render spheres --turntable 3 -o t.#.png --spp 4096 --time-limit 0.5");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(entries(), std::set<std::string>{}) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "stopped by the time limit")) << outcome;
}

TEST_F(SequenceFrames, WithLayersThatAreNotFinishedAreNotWritten) {
    store("moving.json", movingScene());
    const std::string line = "render moving.json --frames 1 -o f.#.exr --width 256 --height 256 --device cpu "
                             "--checkpoint f.#.checkpoint --resume";
    ASSERT_EQ(run(line + " --spp 4").exitCode, 0);
    std::filesystem::remove(folder / "f.1.exr");
    const Outcome stopped = run(line + " --spp 4 --layers albedo,normal --time-limit 0.001");
    EXPECT_EQ(stopped.exitCode, 0) << stopped;
    EXPECT_TRUE(contains(stopped.errors, "f.1.checkpoint has them")) << stopped;
    EXPECT_FALSE(entries().contains("f.1.exr"));
    const Outcome other = run(line + " --spp 2"); // of another picture: it begins anew
    EXPECT_EQ(other.exitCode, 0) << other;
    EXPECT_TRUE(contains(other.errors, "starting from the beginning")) << other;
}

TEST_F(SequenceFrames, HaveNamesAndReasons) {
    store("moving.json", movingScene());
    store("upside.json", R"({"camera": {"path": {"keys": [{"frame": 0}, {"frame": 2, "up": [0, 0, 1]}]}}})");
    const std::string frames = "render moving.json --frames 1..2";
    expectFailure(frames + " -o f.png", 2, {"--output: found f.png", "one run of #"});
    expectFailure(frames + " -o f.#.#.png", 2, {"one run of #"});
    expectFailure(frames + " -o f.#.png --report r.json", 2, {"--report: found r.json"});
    expectFailure("render moving.json --frames 1..11 -o f#.png --report f1#.png", 2,
                  {"f11.png would be two files"});
    expectFailure("render moving.json --frames 2..1 -o f.#.png", 2, {"--frames: found \"2..1\""});
    expectFailure("render spheres --frames 1..2 -o f.#.png", 2,
                  {"--frames: nothing moves in ", "--turntable"});
    expectFailure(frames + " -o f.#.png --look-at 0,0,0", 2, {"--look-at: found beside a camera that moves"});
    expectFailure(frames + " -o f.#.pfm --resume", 2, {"--resume: .exr and .png say which frame they are"});
    expectFailure(frames + " -o f.#.png --partial 1", 2, {"--partial: "});
    expectFailure("render moving.json --fps 3 -o f.png", 2, {"--fps needs --frames"});
    expectFailure(frames + " -o f.#.png --fps 3", 2, {"moving.json: this format has no animations"});
    expectFailure("render upside.json --frames 0..2 -o f.#.png", 3, {"camera of frame 2: up"});
}

} // namespace
} // namespace hyalite::core::testing
