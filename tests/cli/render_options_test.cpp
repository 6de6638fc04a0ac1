// Each option of render has its effect.
#include "host/image/image_file.h"
#include "host/packing/pixel_filter.h"
#include "tests/cli/command_line.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace hyalite::core::testing {
namespace {

class RenderOptions : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        store("sheet.obj", wavySheetObj(12));
        store("sheet.json", wavySheetScene());
        store("square.obj", squareObj());
        store("square.json", squareScene());
        store("empty.json", "{}");
    }
};

const std::string onCpu = " --device cpu";
const std::string smallWithOptions = " --width 16 --height 12 --spp 1 --device cpu";

TEST_F(RenderOptions, OneSideKeepsTheShapeOfThePicture) {
    store("wide.json", R"({"camera": {"width": 200, "height": 100}})");
    const auto sizeOf = [&](const std::string &options) {
        const nlohmann::json image = renderReport("wide.json --spp 1" + onCpu + options).at("image");
        return image.at("width").dump() + "x" + image.at("height").dump();
    };
    EXPECT_EQ(sizeOf(""), "200x100");
    EXPECT_EQ(sizeOf(" --width 30"), "30x15");
    EXPECT_EQ(sizeOf(" --height 30"), "60x30");
    EXPECT_EQ(sizeOf(" --width 30 --height 40"), "30x40");
    EXPECT_EQ(sizeOf(" --width 1"), "1x1");
}

TEST_F(RenderOptions, ScaleIsAShareOfBothSides) {
    const std::string line = "spheres --spp 1 --device cpu ";
    EXPECT_TRUE(renderPfm(line + "--scale 12.5%") == renderPfm(line + "--width 64 --height 64"));
    EXPECT_TRUE(renderPfm(line + "--width 64 --height 48 --scale 50%") ==
                renderPfm(line + "--width 32 --height 24"));
    EXPECT_TRUE(renderPfm(line + "--width 40 --height 30 --scale 100%") ==
                renderPfm(line + "--width 40 --height 30"));
    EXPECT_TRUE(renderPfm(line + "--scale 1e-3%") == renderPfm(line + "--width 1 --height 1"))
        << "at least one pixel";
    for (const char *word : {"25", "0.25", "0%", "101%", "-5%", "%", "x%", "nan%"})
        expectFailure("render spheres -o a.pfm --scale " + std::string(word), 2, {"--scale: found"});
}

TEST_F(RenderOptions, ScaleShowsThePartThatACropWouldShow) {
    const std::string line = "spheres --spp 1 --device cpu ";
    const std::string smaller = line + "--width 32 --height 24 ";
    EXPECT_TRUE(renderPfm(line + "--width 64 --height 48 --scale 50% --crop 8,24,10,30") ==
                renderPfm(smaller + "--crop 4,12,5,15"));
    EXPECT_TRUE(renderPfm(line + "--width 64 --height 48 --scale 50% --crop 9,23,11,29") ==
                renderPfm(smaller + "--crop 4,12,5,15"))
        << "pixels that are shown in part are there";
    EXPECT_TRUE(renderPfm(line + "--width 64 --height 48 --scale 50% --crop 63,64,47,48") ==
                renderPfm(smaller + "--crop 31,32,23,24"));
    expectFailure("render spheres -o a.pfm --width 64 --height 48 --scale 50% --crop 0,65,0,48", 2,
                  {"--crop", "64x48"});
}

TEST_F(RenderOptions, SppIsTheNumberOfPrimaryRaysInAPixel) {
    for (const char *spp : {"1", "5", "64"}) {
        const nlohmann::json report =
            renderReport("spheres --width 16 --height 12 --device cpu --spp " + std::string(spp));
        EXPECT_EQ(report.at("settings").at("spp"), std::stoi(spp));
        EXPECT_EQ(report.at("rays").at("primary"), 16 * 12 * std::stoi(spp));
    }
}

TEST_F(RenderOptions, ManySamplesAreRenderedAlikeOnDeviceAndCpu) {
    const std::string line = "sheet.json --width 5 --height 4 --spp 1024";
    EXPECT_EQ(renderPfm(line + onCpu), renderPfm(line + " --device " + softwareDevice()));
}

TEST_F(RenderOptions, TheSeedChangesSobolAndNotCentre) {
    EXPECT_NE(renderPfm("spheres --sampler sobol --seed 1" + smallWithOptions),
              renderPfm("spheres --sampler sobol --seed 2" + smallWithOptions));
    EXPECT_EQ(renderPfm("spheres --sampler centre --seed 1" + smallWithOptions),
              renderPfm("spheres --sampler centre --seed 2" + smallWithOptions));
    EXPECT_EQ(renderPfm("spheres --seed 4294967295" + smallWithOptions),
              renderPfm("spheres --seed 4294967295" + smallWithOptions));
}

TEST_F(RenderOptions, CentreRepeatsOneSample) {
    const std::string line = "spheres --sampler centre --width 16 --height 12 --device cpu --spp ";
    EXPECT_EQ(renderPfm(line + "1"), renderPfm(line + "2"));
}

TEST_F(RenderOptions, SobolIsTheDefaultAndSmoothsEdges) {
    store("plain.json", squareScene().replace(squareScene().find(", \"sampler\": \"centre\""), 21, ""));
    EXPECT_EQ(renderPfm("plain.json" + onCpu), renderPfm("plain.json --sampler sobol" + onCpu));
    // Pixels between black and the square's own grey are those that its edge crosses.
    const auto greyCount = [&](const std::string &sampler) {
        const Image image =
            renderImage("plain.json --device cpu --width 31 --height 23 --spp 64 --sampler " + sampler);
        const float full = image.at(15, 11).x;
        int count = 0;
        for (const glm::vec3 &pixel : image.pixels())
            count += pixel.x > 0.02f * full && pixel.x < 0.9f * full ? 1 : 0;
        return count;
    };
    EXPECT_EQ(greyCount("centre"), 0);
    EXPECT_GT(greyCount("sobol"), 10);
}

TEST_F(RenderOptions, MaxDepthCountsSegments) {
    const std::string line = "spheres --width 32 --height 24 --spp 1 --device cpu --max-depth ";
    const nlohmann::json one = renderReport(line + "1");
    EXPECT_EQ(one.at("rays").at("reflection"), 0);
    EXPECT_EQ(one.at("rays").at("refraction"), 0);
    const std::string oneBytes = load("reported.pfm");
    const nlohmann::json two = renderReport(line + "2");
    EXPECT_GT(two.at("rays").at("reflection"), 0);
    EXPECT_NE(load("reported.pfm"), oneBytes);
    EXPECT_GT(renderReport(line + "12").at("rays").at("total"), two.at("rays").at("total"));
}

TEST_F(RenderOptions, EveryDepthIsRenderedAlikeOnDeviceAndCpu) {
    const std::string device = " --device " + softwareDevice();
    for (const char *depth : {"1", "2", "3", "8", "12"}) {
        const std::string line = "spheres-nested --width 24 --height 18 --spp 1 --max-depth ";
        EXPECT_EQ(renderPfm(line + depth + onCpu), renderPfm(line + depth + device)) << depth;
    }
}

TEST_F(RenderOptions, TheDeepestPathIsRenderedAlikeOnDeviceAndCpu) {
    // From inside of a mirror ball: nearly every path is as long as it may be.
    store("hall.json", R"({
  "camera": { "position": [1, 0, 3], "horizontalFov": 90, "width": 16, "height": 12 },
  "lights": [ { "type": "point", "position": [0, 3, 0], "power": 500 } ],
  "materials": { "mirror": { "type": "mirror" }, "grey": { "type": "diffuse" } },
  "spheres": [ { "centre": [0, 0, 0], "radius": 5, "material": "mirror", "inwardNormal": true },
               { "centre": [0, -1, 0], "radius": 0.5, "material": "grey" } ],
  "settings": { "maxDepth": 32, "spp": 1 }
})");
    const nlohmann::json report = renderReport("hall.json" + onCpu);
    EXPECT_GT(report.at("rays").at("reflection"), 16 * 12 * 16);
    EXPECT_EQ(renderPfm("hall.json --device " + softwareDevice()), load("reported.pfm"));
}

TEST_F(RenderOptions, TheTreeDoesNotChangeTheImage) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const std::string line = "sheet.json --device " + device;
        const std::string wanted = renderPfm(line + " --bvh none");
        ASSERT_FALSE(wanted.empty());
        for (const char *tree : {"midpoint", "sah"})
            for (const char *leafSize : {"1", "8", "64"})
                EXPECT_EQ(renderPfm(line + " --bvh " + tree + " --leaf-size " + leafSize), wanted)
                    << device << ", " << tree << ", " << leafSize;
    }
}

TEST_F(RenderOptions, TreeLeafSizeSamplerAndSeedAreInTheReport) {
    const nlohmann::json settings =
        renderReport("sheet.json --bvh sah --leaf-size 3 --sampler centre --seed 7 --exposure -1.5" +
                     smallWithOptions)
            .at("settings");
    EXPECT_EQ(settings.at("bvh"), "sah");
    EXPECT_EQ(settings.at("leafSize"), 3);
    EXPECT_EQ(settings.at("sampler"), "centre");
    EXPECT_EQ(settings.at("seed"), 7);
    EXPECT_EQ(settings.at("exposure"), -1.5);
}

TEST_F(RenderOptions, TheFilterSpreadsAnEdgeByItsShare) {
    // A black wall in front of a white sky ends on a line between two columns of pixels.
    store("wall.obj", "v -9 -9 -5\nv 0 -9 -5\nv 0 9 -5\nv -9 9 -5\nf 1 2 3 4\n");
    store("wall.json", R"({
  "background": 1,
  "camera": { "position": [0, 0, 0], "direction": [0, 0, -1], "horizontalFov": 40, "width": 8, "height": 6 },
  "materials": { "black": { "type": "diffuse", "albedo": 0 } },
  "meshes": [ { "file": "wall.obj", "material": "black" } ],
  "settings": { "spp": 4096, "filter": "blackman-harris" }
})");
    const Image wide = renderImage("wall.json --device " + softwareDevice());
    const Image narrow = renderImage("wall.json --filter box --device " + softwareDevice());
    for (int x = 0; x < 8; ++x) {
        const float value = wide.pixels()[static_cast<std::size_t>(2 * 8 + x)].x;
        EXPECT_NEAR(value, filterShareBelow(x + 0.5 - 4.0), 0.003) << x;
        EXPECT_EQ(narrow.pixels()[static_cast<std::size_t>(2 * 8 + x)].x, x < 4 ? 0.0f : 1.0f) << x;
    }
    EXPECT_EQ(renderReport("wall.json --spp 1" + onCpu).at("settings").at("filter"), "blackman-harris");
    expectFailure("render wall.json -o a.png --sampler centre", 2, {"--filter", "sampler sobol"});
    store("centre.json", R"({ "settings": { "sampler": "centre", "filter": "blackman-harris" } })");
    expectFailure("render centre.json -o a.png", 3, {"centre.json", "filter", "sobol"});
}

TEST_F(RenderOptions, FovIsHorizontal) {
    // From 10 away, a square of side 2 covers 1 / (10 tan(fov/2)) of the width.
    for (const double fov : {20.0, 60.0, 120.0}) {
        const Image image =
            renderImage("square.json --width 101 --height 75 --device cpu --fov " + std::to_string(fov));
        const double side = 101.0 / (10.0 * std::tan(fov * 3.14159265358979 / 360.0));
        EXPECT_NEAR(std::sqrt(litPixelCount(image)), side, 1.0) << fov;
    }
}

TEST_F(RenderOptions, CameraPositionKeepsTheDirection) {
    const int near = litPixelCount(renderImage("square.json --camera-position 0,0,8" + onCpu));
    const int far = litPixelCount(renderImage("square.json --camera-position 0,0,20" + onCpu));
    EXPECT_GT(near, 4 * far);
    EXPECT_GT(far, 0);
    // Moved aside by more than it sees, and still looking along -z.
    EXPECT_EQ(litPixelCount(renderImage("square.json --camera-position 9,0,10" + onCpu)), 0);
}

TEST_F(RenderOptions, LookAtTurnsTheCamera) {
    EXPECT_EQ(litPixelCount(renderImage("square.json --look-at 0,0,20" + onCpu)), 0);
    const Image image = renderImage("square.json --camera-position -9,3,8 --look-at 0,0,0" + onCpu);
    EXPECT_NE(image.at(16, 12), glm::vec3(0.0f));
    EXPECT_EQ(renderPfm("square.json --look-at 0,0,-7" + onCpu), renderPfm("square.json" + onCpu));
}

TEST_F(RenderOptions, ABareMeshIsLookedAtFromWhereTheCameraIsPut) {
    for (const char *position : {"0,0,6", "5,2,-4", "-6,-1,0.5"}) {
        const std::string line =
            std::string("square.obj --width 33 --height 25 --device cpu --camera-position ") + position;
        const Image image = renderImage(line);
        EXPECT_NE(image.at(16, 12), image.at(0, 0)) << position;
        EXPECT_EQ(renderPfm(line), renderPfm(line + " --look-at 0,0,0")) << position;
    }
    expectFailure("render square.obj -o a.png --camera-position 0,0,0", 2, {"--look-at"});
    expectFailure("render square.obj -o a.png --camera-position 0,5,0", 2,
                  {"--camera-position", "up: found the view direction's own axis"});
}

TEST_F(RenderOptions, UpsideDownIsTheImageTurned) {
    const Image image = renderImage("sheet.json --sampler centre" + onCpu);
    const Image turned = renderImage("sheet.json --sampler centre --up 0,-1,0" + onCpu);
    ASSERT_EQ(turned.width(), 16);
    int differenceCount = 0;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x) {
            const glm::vec3 difference = image.at(x, y) - turned.at(15 - x, 11 - y);
            differenceCount += glm::dot(difference, difference) > 1e-4f ? 1 : 0;
        }
    EXPECT_LE(differenceCount, 2); // of 192: rays are rounded otherwise, at an edge that may show
}

TEST_F(RenderOptions, VectorsMayBeWrittenWithCommasOrSpaces) {
    const std::string wanted = renderPfm("square.json --camera-position -1,2,8" + onCpu);
    EXPECT_EQ(renderPfm("square.json --camera-position=-1,2,8" + onCpu), wanted);
    EXPECT_EQ(renderPfm("square.json --camera-position -1 2 8" + onCpu), wanted);
    EXPECT_EQ(renderPfm("square.json --camera-position '-1, 2, 8'" + onCpu), wanted);
    EXPECT_EQ(renderPfm("square.json --camera-position -1.0,2e0,.8e1" + onCpu), wanted);
}

TEST_F(RenderOptions, BackgroundIsWhatRaysSeeThatMeetNothing) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const Image image =
            renderImage("empty.json --width 5 --height 4 --background .25,0.5,3 --device " + device);
        ASSERT_EQ(image.pixels().size(), 20u);
        for (const glm::vec3 &pixel : image.pixels())
            EXPECT_EQ(pixel, glm::vec3(0.25f, 0.5f, 3.0f)) << device;
    }
}

class RenderEnvironment : public RenderOptions {
  protected:
    /// Stores an environment that is different in each direction.
    void SetUp() override {
        RenderOptions::SetUp();
        Image sky(8, 4);
        for (int y = 0; y < sky.height(); ++y)
            for (int x = 0; x < sky.width(); ++x)
                sky.at(x, y) = {1.0f + static_cast<float>(x), 2.0f + static_cast<float>(y), 0.5f};
        AtomicFile file(folder / "sky.pfm");
        writeImage(file, imageFormatOf("sky.pfm"), sky, 0.0);
        file.commit();
    }
    /// What is seen by a camera at the origin. `direction` is written as X,Y,Z.
    [[nodiscard]] Image seen(const std::string &direction, const std::string &options) const {
        return renderImage(
            "empty.json --environment sky.pfm --integrator path --sampler centre --width 6 --height 6 "
            "--fov 60 --spp 1 --device cpu --camera-position 0,0,0 --look-at " +
            direction + options);
    }
    static void expectAlike(const Image &a, const Image &b, float factor) {
        ASSERT_EQ(a.pixels().size(), b.pixels().size());
        for (std::size_t i = 0; i < a.pixels().size(); ++i)
            EXPECT_LT(glm::length(a.pixels()[i] * factor - b.pixels()[i]), 1e-4f * glm::length(b.pixels()[i]))
                << i;
    }
};

TEST_F(RenderEnvironment, IsThatOfTheOption) {
    const Image ahead = seen("0,0,-1", "");
    EXPECT_GT(ahead.at(5, 3).x, ahead.at(0, 3).x + 0.5f) << "the image runs from left to right";
    expectAlike(ahead, seen("0,0,-1", " --environment-scale 2.5"), 2.5f);
    expectAlike(ahead, seen("-1,0,0", " --environment-rotate 90"), 1.0f);
    expectAlike(ahead, seen("0,0,1", " --environment-rotate 180"), 1.0f);
}

TEST_F(RenderEnvironment, ReplacesThatOfTheScene) {
    store("own.json", R"({"environment": {"file": "sky.pfm", "scale": 7, "rotateDegrees": 33}})");
    const std::string around = " --integrator path --width 6 --height 6 --spp 1 --device cpu";
    EXPECT_NE(renderPfm("own.json" + around), renderPfm("own.json --environment sky.pfm" + around));
    EXPECT_EQ(renderPfm("empty.json --environment sky.pfm" + around),
              renderPfm("own.json --environment sky.pfm" + around));
    expectFailure("render empty.json -o a.png --environment-scale 2", 2,
                  {"--environment-scale", "--environment"});
    expectFailure("render empty.json -o a.png --environment none.hdr", 3, {"none.hdr"});
    expectFailure("render empty.json -o a.png --environment square.obj", 3, {"square.obj"});
}

/// A triangle of glTF that its camera does not see, with a lamp or without lights.
std::string unseenTriangleGltf(bool hasLamp) {
    std::string text = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, -5])";
    text += hasLamp ? R"(, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},)"
                    : "}],";
    return text + R"("cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri":
            "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST_F(RenderEnvironment, NeutralIsAskedForByName) {
    store("lamp.gltf", unseenTriangleGltf(true));
    store("dark.gltf", unseenTriangleGltf(false));
    store("empty.json", R"({"camera": {"direction": [0, 0, -1], "horizontalFov": 57.29577951308232}})");
    const std::string small = " --integrator path --width 6 --height 6 --spp 1 --device cpu";
    const std::string own = renderPfm("dark.gltf" + small);
    EXPECT_EQ(renderPfm("lamp.gltf --environment neutral" + small), own);
    EXPECT_EQ(renderPfm("empty.json --environment neutral" + small), own);
    EXPECT_NE(renderPfm("lamp.gltf" + small), own);
    EXPECT_NE(renderPfm("lamp.gltf --environment neutral --environment-scale 2" + small), own);
    expectFailure("render lamp.gltf -o a.png --environment ./neutral", 3, {"neutral"});
}

TEST_F(RenderEnvironment, IsReplacedByABackground) {
    store("own.json", R"({"environment": {"file": "sky.pfm"}})");
    store("dark.gltf", unseenTriangleGltf(false));
    store("square.obj", squareObj());
    const std::string red =
        " --background 1,.5,.25 --integrator path --width 6 --height 6 --spp 1 --device cpu";
    for (const std::string scene :
         {"own.json", "dark.gltf", "square.obj --camera-position 0,0,9 --look-at 0,0,99"}) {
        const Image seen = renderImage(scene + red);
        for (const glm::vec3 &pixel : seen.pixels())
            EXPECT_EQ(pixel, glm::vec3(1.0f, 0.5f, 0.25f)) << scene;
    }
    expectFailure("render own.json -o a.png --background 1,1,1 --environment sky.pfm", 2,
                  {"--background", "an environment"});
    expectFailure("render dark.gltf -o a.png --background 1,1,1 --environment-scale 2", 2,
                  {"--environment-scale"});
}

TEST_F(RenderOptions, ExposureBrightensAPngAndNotAPfm) {
    EXPECT_EQ(renderPfm("spheres --exposure 3" + smallWithOptions), renderPfm("spheres" + smallWithOptions));
    const auto grey = [&](const std::string &exposure) {
        const std::string line = "render empty.json -o a.png --background .125,.125,.125 --exposure ";
        EXPECT_EQ(run(line + exposure + smallWithOptions).exitCode, 0);
        return std::lround(255.0f * readImage(folder / "a.png").image.at(0, 0).x);
    };
    EXPECT_EQ(grey("0"), std::lround(255.0 * std::pow(0.125, 1.0 / 2.2)));
    EXPECT_EQ(grey("1"), std::lround(255.0 * std::pow(0.25, 1.0 / 2.2)));
    EXPECT_EQ(grey("-1.5"), std::lround(255.0 * std::pow(0.125 * std::exp2(-1.5), 1.0 / 2.2)));
    EXPECT_EQ(grey("3"), 255);
    EXPECT_EQ(grey("100"), 255);
    EXPECT_EQ(grey("-100"), 0);
}

TEST_F(RenderOptions, TheCommandLineBeatsTheSceneFile) {
    store("own.json", R"({"camera": {"width": 9, "height": 7, "horizontalFov": 20},
                          "settings": {"spp": 3, "maxDepth": 4, "bvh": "sah", "leafSize": 2, "seed": 5,
                                       "sampler": "centre", "clamp": 6, "exposure": 2}})");
    const nlohmann::json own = renderReport("own.json --device cpu");
    EXPECT_EQ(own.at("image"), (nlohmann::json{{"width", 9}, {"height", 7}}));
    const nlohmann::json wanted{{"integrator", "whitted"}, {"spp", 3},
                                {"maxDepth", 4},           {"bvh", "sah"},
                                {"leafSize", 2},           {"seed", 5},
                                {"sampler", "centre"},     {"clamp", 6.0},
                                {"exposure", 2.0},         {"occlusionDistance", 1e15},
                                {"filter", "box"},         {"lightChoice", "auto"},
                                {"alpha", false},          {"alphaThroughGlass", false},
                                {"lightLayers", false},    {"lightGroups", false},
                                {"denoise", false},        {"denoisingData", false},
                                {"layersThrough", false},  {"noise", 0.0}};
    EXPECT_EQ(own.at("settings"), wanted);
    const nlohmann::json overridden =
        renderReport("own.json --width 4 --spp 2 --integrator path --clamp 0.5" + onCpu);
    EXPECT_EQ(overridden.at("image"), (nlohmann::json{{"width", 4}, {"height", 3}})) << "of 9 to 7";
    EXPECT_EQ(overridden.at("settings").at("spp"), 2);
    EXPECT_EQ(overridden.at("settings").at("clamp"), 0.5);
    EXPECT_EQ(overridden.at("settings").at("maxDepth"), 4);
}

TEST_F(RenderOptions, DefaultsAreThoseOfTheSceneFormat) {
    const nlohmann::json report = renderReport("empty.json --crop 0,1,0,1" + onCpu);
    const nlohmann::json wanted{{"integrator", "whitted"},
                                {"spp", 16},
                                {"maxDepth", 7},
                                {"bvh", "midpoint"},
                                {"leafSize", 8},
                                {"seed", 0},
                                {"sampler", "sobol"},
                                {"filter", "box"},
                                {"exposure", 0.0},
                                {"occlusionDistance", 1e15},
                                {"clamp", 0.0},
                                {"lightChoice", "auto"},
                                {"alpha", false},
                                {"alphaThroughGlass", false},
                                {"lightLayers", false},
                                {"lightGroups", false},
                                {"denoise", false},
                                {"denoisingData", false},
                                {"layersThrough", false},
                                {"noise", 0.0}};
    EXPECT_EQ(report.at("settings"), wanted);
    expectFailure("render empty.json -o a.png --crop 0,513,0,512", 2, {"512x512"});
}

TEST_F(RenderOptions, APanoramaHasNoFieldOfView) {
    store("around.json", R"({"camera": {"type": "panorama", "width": 8, "height": 4}})");
    EXPECT_EQ(run("render around.json -o around.pfm --device cpu").exitCode, 0);
    expectFailure("render around.json -o around.pfm --fov 60", 2, {"--fov", "panorama", "perspective"});
}

TEST_F(RenderOptions, AnEnvironmentLightsABareMeshInPlaceOfLights) {
    store("square.obj", squareObj());
    store("white.pfm", std::string("PF\n1 1\n-1.0\n") + std::string("\0\0\x80?\0\0\x80?\0\0\x80?", 12));
    const std::string line = "square.obj --environment white.pfm --width 8 --height 8 --spp 4 --device cpu";
    const Image lit = renderImage(line);
    // Of a white furnace: the square shows its albedo.
    EXPECT_GT(lit.at(4, 4).x, 0.1f);
    EXPECT_LT(lit.at(4, 4).x, 0.9f);
    EXPECT_EQ(renderReport(line).at("settings").at("integrator"), "path");
    EXPECT_EQ(renderReport(line + " --integrator whitted").at("settings").at("integrator"), "whitted");
}

} // namespace
} // namespace hyalite::core::testing
