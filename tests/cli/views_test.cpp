// Views: pictures of a scene from several sides, in a sheet or in files of their own.
#include "host/image/contact_sheet.h"
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"
#include "tests/fixtures/gltf_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hyalite::core::testing {
namespace {

using RenderedViews = CommandLine;

const std::string smallView = " --width 32 --height 24 --spp 2 --device cpu --quiet";

/// A closed box around the origin, 2 x 1 x 4, with one corner that is cut off.
std::string blockObj() {
    return "v -1 -.5 -2\nv 1 -.5 -2\nv 1 .5 -2\nv -1 .5 -2\nv -1 -.5 2\nv 1 -.5 2\nv 1 .5 2\nv -1 .5 2\n"
           "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

double meanOf(const Image &image) {
    double sum = 0.0;
    for (const glm::vec3 &pixel : image.pixels())
        sum += static_cast<double>(pixel.y);
    return sum / static_cast<double>(image.pixels().size());
}

TEST_F(RenderedViews, AreThePicturesOfCamerasPutThere) {
    // A ball of radius 1 in the middle: half its diagonal is sqrt(3), and the box decides how far the camera is.
    store("ball.json", R"({"camera": {"position": [0, 9, 40]}, "background": 0.3,
        "materials": {"grey": {"type": "diffuse"}}, "lights": [{"type": "point", "position": [3, 9, 9], "power": 1e3}],
        "spheres": [{"centre": [0, 0, 0], "radius": 1, "material": "grey"}]})");
    ASSERT_EQ(run("render ball.json --views front,right,top -o {view}.pfm" + smallView).exitCode, 0);
    // The nearer face of the box fills the image's height but for 8 %.
    const double distance = 1.0 + 1.0 / (0.92 * std::tan(20.0 * 3.14159265358979 / 180.0) * 24.0 / 32.0);
    const std::string at = fmt::format("{:.17g}", distance);
    const auto expectLike = [&](const std::string &view, const std::string &camera) {
        static_cast<void>(renderPfm("ball.json --fov 40 --look-at 0,0,0 --camera-position " + camera +
                                    " --width 32 --height 24 --spp 2 --device cpu"));
        const Outcome diff = run("diff " + view + ".pfm rendered.pfm --min-psnr 60");
        EXPECT_EQ(diff.exitCode, 0) << view << diff;
    };
    expectLike("front", "0,0," + at);
    expectLike("right", at + ",0,0");
    expectLike("top", "0," + at + ",0 --up 0,0,-1");
}

TEST_F(RenderedViews, InAPngAreASheetOfThosePictures) {
    store("block.obj", blockObj());
    ASSERT_EQ(run("render block.obj --views front,top,iso -o sheet.png" + smallView).exitCode, 0);
    ASSERT_EQ(run("render block.obj --views front,top,iso -o {view}.png" + smallView).exitCode, 0);
    const Image sheet = readImage(folder / "sheet.png").image;
    const SheetSize size = sheetSize(3, 32, 24);
    EXPECT_EQ(sheet.width(), size.width);
    EXPECT_EQ(sheet.height(), size.height);
    for (const char *view : {"front", "top", "iso"}) {
        const Image picture = readImage(folder / (std::string(view) + ".png")).image;
        const auto isAt = [&](int x0, int y0) {
            for (int y = 0; y < 24; ++y)
                if (!std::equal(&picture.pixels()[static_cast<std::size_t>(32 * y)],
                                &picture.pixels()[static_cast<std::size_t>(32 * y)] + 32,
                                &sheet.pixels()[static_cast<std::size_t>(sheet.width() * (y0 + y) + x0)]))
                    return false;
            return true;
        };
        int foundCount = 0;
        for (int y = 0; y + 24 <= sheet.height(); ++y)
            for (int x = 0; x + 32 <= sheet.width(); ++x)
                foundCount += isAt(x, y) ? 1 : 0;
        EXPECT_EQ(foundCount, 1) << view;
    }
    EXPECT_TRUE(contains(load("sheet.png"), "front,top,iso")) << "as an attribute";
}

TEST_F(RenderedViews, OfABareMeshAreAllLit) {
    store("block.obj", blockObj());
    ASSERT_EQ(
        run("render block.obj --views front,back,left,right,top,bottom -o {view}.pfm" + smallView).exitCode,
        0);
    for (const char *view : {"front", "back", "left", "right", "top", "bottom"}) {
        const Image image = readImage(folder / (std::string(view) + ".pfm")).image;
        const glm::vec3 middle = image.pixels()[static_cast<std::size_t>(32 * 12 + 16)];
        EXPECT_GT(middle.y, 0.4f) << view;
    }
    const double front = meanOf(readImage(folder / "front.pfm").image);
    EXPECT_NEAR(meanOf(readImage(folder / "back.pfm").image), front, 0.01 * front)
        << "the block is symmetric";
    EXPECT_NEAR(meanOf(readImage(folder / "top.pfm").image), meanOf(readImage(folder / "bottom.pfm").image),
                0.01 * front);
}

TEST_F(RenderedViews, OfADeviceHaveTheBitsOfTheCpu) {
    store("block.obj", blockObj());
    const std::string line =
        "render block.obj --views iso,bottom,contact:2 --width 32 --height 24 --spp 2 --quiet";
    ASSERT_EQ(run(line + " -o cpu-{view}.pfm --device cpu").exitCode, 0);
    ASSERT_EQ(run(line + " -o device-{view}.pfm --device " + softwareDevice()).exitCode, 0);
    for (const std::string view : {"iso", "bottom", "contact-1", "contact-2"})
        EXPECT_TRUE(load("cpu-" + view + ".pfm") == load("device-" + view + ".pfm")) << view;
    EXPECT_FALSE(load("cpu-contact-1.pfm") == load("cpu-contact-2.pfm"));
}

TEST_F(RenderedViews, FrameAnObjectByItsName) {
    GltfMaker maker = oneTriangle();
    maker.json["meshes"][0]["name"] = "Tile";
    maker.json["nodes"] = {{{"name", "Group"}, {"children", {1, 2}}},
                           {{"name", "Left"}, {"mesh", 0}},
                           {{"name", "Right"}, {"mesh", 0}, {"translation", {100, 0, 0}}}};
    store("two.glb", maker.glb());
    const auto litShare = [&](const std::string &frame) {
        const Image image = renderImage(
            "two.glb --views front --integrator albedo --device cpu --width 40 --height 40 --spp 1" + frame);
        return static_cast<double>(litPixelCount(image)) / 1600.0;
    };
    const double whole = litShare("");
    EXPECT_LT(whole, 0.02);
    EXPECT_EQ(litShare(" --frame Group"), whole);
    EXPECT_EQ(litShare(" --frame Tile"), whole) << "the mesh of both";
    EXPECT_GT(litShare(" --frame Left"), 0.2);
    EXPECT_GT(litShare(" --frame Right"), 0.2);
    EXPECT_EQ(litShare(" --frame 2"), litShare(" --frame Right")) << "by its index";
    expectFailure("render two.glb -o a.png --views front --frame right", 2,
                  {"--frame: found no object \"right\"", "\"Group\", \"Left\", \"Right\", \"Tile\"",
                   "did you mean \"Right\"?"});
}

TEST_F(RenderedViews, KeepUpAndTheFieldOfView) {
    store("block.obj", blockObj());
    const std::string line = "block.obj --integrator normal --width 32 --height 24 --spp 1 --device cpu";
    EXPECT_TRUE(renderPfm(line + " --views front --up z") != renderPfm(line + " --views front"));
    EXPECT_TRUE(renderPfm(line + " --views front --fov 90") != renderPfm(line + " --views front"));
}

TEST_F(RenderedViews, AreExrFilesWithTheirNameAndReports) {
    ASSERT_EQ(
        run("render spheres --views front,iso -o {view}.exr --report {view}.json --layers depth" + smallView)
            .exitCode,
        0);
    EXPECT_EQ(entries(), (std::set<std::string>{"front.exr", "front.json", "iso.exr", "iso.json"}));
    EXPECT_EQ(nlohmann::json::parse(load("iso.json")).at("output"), "iso.exr");
    EXPECT_TRUE(contains(load("iso.exr"), "view"));
}

TEST_F(RenderedViews, EndWithTheTimeLimit) {
    const Outcome outcome = run("render cat --views front,top -o a.png --width 512 --height 512 --spp 4096"
                                " --time-limit 0.2 --device cpu --quiet");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "stopped by the time limit: 0 of 2 views are finished")) << outcome;
    EXPECT_EQ(readImage(folder / "a.png").image.width(), sheetSize(2, 512, 512).width);
}

TEST_F(RenderedViews, WhatDoesNotFitIsRefused) {
    const auto refuse = [&](const std::string &line, const std::vector<std::string> &parts) {
        expectFailure("render spheres " + line, 2, parts);
    };
    refuse("-o a.exr --views front,top", {"--output: found a.exr", "{view}"});
    refuse("-o a.png --views frnt", {"--views: found \"frnt\"", "did you mean \"front\"?", "contact:N"});
    refuse("-o a.png --views contact:0", {"--views", "from 1 to 64"});
    refuse("-o a.png --views top,front,top", {"--views: found top twice"});
    refuse("-o a.png --views top,front --report a.json", {"--report"});
    refuse("-o a.png --views top --camera-position 1,2,3", {"--camera-position"});
    refuse("-o a.png --views top --look-at 1,2,3", {"--look-at"});
    refuse("-o a.png --frame top", {"--frame needs --views"});
    refuse("-o a.#.png --views top --frames 0..3", {"--frames: found --views"});
    refuse("-o a.#.png --views top --turntable 3", {"--turntable: found --views"});
    refuse("-o a.part --views top --part 1/2", {"--part: found --views"});
    refuse("-o a.png --views top --checkpoint c", {"--checkpoint: found --views"});
    refuse("-o a.png --views top --partial 1", {"--partial: found --views"});
    refuse("-o a.png --views top --frame a",
           {"--frame: found no object \"a\"", "nothing in the scene has a name"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

} // namespace
} // namespace hyalite::core::testing
