// Pictures as other programs see them: OpenEXR's tools, OpenImageIO, ImageMagick; and the options of files.
#include "host/image/exr.h"
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <sys/wait.h>

namespace hyalite::core::testing {
namespace {

const std::string brief = " --width 24 --height 16 --spp 2 --device cpu --quiet";

class ExrFiles : public CommandLine {
  protected:
    /// What a program of a package prints, in the folder.
    [[nodiscard]] std::string printedBy(const std::string &command, const std::string &package) const {
        FILE *const pipe = popen(("cd '" + folder.string() + "' && " + command + " 2>&1").c_str(), "r");
        std::string text;
        std::array<char, 4096> bytes{};
        while (const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), pipe))
            text.append(bytes.data(), count);
        const int status = pclose(pipe);
        EXPECT_EQ(WEXITSTATUS(status), 0)
            << command << "\n"
            << text << "\nthis test needs " << package << " (cmake/run.sh test installs it)";
        return text;
    }

    /// A picture with alpha, by hand: a ramp of colours, and of alpha from 0 to 1.
    void storeWithAlpha(const std::string &name, float alphaScale = 1.0f) const {
        Image image(8, 4);
        std::vector<float> alpha;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 8; ++x) {
                alpha.push_back(alphaScale * static_cast<float>(x) / 7.0f);
                image.at(x, y) = alpha.back() * glm::vec3(0.25f, 0.5f, static_cast<float>(y) / 3.0f);
            }
        Picture picture(image);
        picture.alpha = alpha;
        AtomicFile file(folder / name);
        writeImage(file, imageFormatOf(name), picture, 0.0);
        file.commit();
    }

    /// The floats of a file of nothing else.
    [[nodiscard]] std::vector<float> floatsIn(const std::string &name) const {
        const std::string bytes = load(name);
        std::vector<float> values(bytes.size() / sizeof(float));
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
};

const std::string ballScene = R"({"camera": {CAMERA},
    "materials": {"m": {"type": "diffuse", "albedo": 0.5}},
    "spheres": [{"centre": BALL, "radius": RADIUS, "material": "m"}],
    "lights": [{"type": "directional", "direction": [0, -1, -1], "irradiance": [1, 1, 1]}]})";

// Texts differ from run to run; all else is written down.
TEST_F(ExrFiles, TheHeaderOfAllLayersIsWrittenDown) {
    store("scene.json", R"({"camera": {"position": [0, 0, 10], "horizontalFov": 90},
        "materials": {"m": {"type": "diffuse", "albedo": 0.5}},
        "spheres": [{"centre": [0, 0, 0], "radius": 4, "material": "m"}],
        "lights": [{"type": "point", "position": [0, 9, 9], "power": [900, 900, 900]}]})");
    ASSERT_EQ(run("render scene.json -o a.exr --crop 4,20,2,14 --layers albedo,ao,normal,depth,id,uv --half "
                  "--exr-compression piz" +
                  brief)
                  .exitCode,
              0);
    const std::string printed =
        std::regex_replace(printedBy("exrheader a.exr", "openexr"),
                           std::regex(R"( \(type string\): "[^"]*")"), " (type string)");
    std::string types;
    std::string names;
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);)
        if (line.ends_with("(type string)"))
            names += line.substr(0, line.find(' ')) + " ";
        else
            types += line + "\n";
    EXPECT_EQ(types, R"(
file a.exr:

file format version: 2, flags 0x0
channels (type chlist):
    B, 16-bit floating-point, sampling 1 1
    G, 16-bit floating-point, sampling 1 1
    R, 16-bit floating-point, sampling 1 1
    Z, 32-bit floating-point, sampling 1 1
    albedo.B, 16-bit floating-point, sampling 1 1
    albedo.G, 16-bit floating-point, sampling 1 1
    albedo.R, 16-bit floating-point, sampling 1 1
    ao.Y, 16-bit floating-point, sampling 1 1
    id.B, 32-bit floating-point, sampling 1 1
    id.G, 32-bit floating-point, sampling 1 1
    id.R, 32-bit floating-point, sampling 1 1
    normal.X, 32-bit floating-point, sampling 1 1
    normal.Y, 32-bit floating-point, sampling 1 1
    normal.Z, 32-bit floating-point, sampling 1 1
    samples.Y, 32-bit unsigned integer, sampling 1 1
    uv.U, 32-bit floating-point, sampling 1 1
    uv.V, 32-bit floating-point, sampling 1 1
    variance.B, 32-bit floating-point, sampling 1 1
    variance.G, 32-bit floating-point, sampling 1 1
    variance.R, 32-bit floating-point, sampling 1 1
chromaticities (type chromaticities):
    red   (0.64 0.33)
    green (0.3 0.6)
    blue  (0.15 0.06)
    white (0.3127 0.329)
compression (type compression): piz
dataWindow (type box2i): (4 2) - (19 13)
displayWindow (type box2i): (0 0) - (23 15)
lineOrder (type lineOrder): increasing y
pixelAspectRatio (type float): 1
screenWindowCenter (type v2f): (0 0)
screenWindowWidth (type float): 2
worldToCamera (type m44f):
   (1 0 0 0
    0 1 0 0
    0 0 -1 0
    0 0 10 1)
worldToNDC (type m44f):
   (0.5 0 0 0
    0 -0.75 0 0
    -0.5 -0.5 -1 -1
    5 5 9 10)

)") << printed;
    EXPECT_EQ(
        names,
        "commandLine device.arithmetic device.driver device.equalBits device.name image.height image.width "
        "pixels "
        "scene sceneHash settings.alpha settings.alphaThroughGlass settings.bvh settings.clamp "
        "settings.denoise settings.denoisingData "
        "settings.exposure settings.filter settings.integrator "
        "settings.layersThrough settings.leafSize settings.lightChoice settings.lightGroups "
        "settings.lightLayers settings.maxDepth "
        "settings.noise settings.occlusionDistance "
        "settings.sampler "
        "settings.seed settings.spp software triangles type ");
}

/// Where the camera's matrices put points, and where the picture shows them.
TEST_F(ExrFiles, PointsAreWhereTheMatricesPutThem) {
    struct Case {
        std::string camera;
        glm::dvec3 ball;
        double radius;
        double tolerancePixels;
    };
    const std::string turned = R"("position": [3, 4, 9], "target": [0.5, 0, -1], "up": [0.2, 1, 0.1])";
    const std::vector<Case> cases{
        {turned + R"(, "horizontalFov": 50)", {1.5, 1.0, -0.5}, 0.4, 0.1},
        {turned + R"(, "horizontalFov": 50, "aperture": 0.1, "focusDistance": 10)",
         {-1.0, -0.5, 0.5},
         0.4,
         0.15},
        {turned + R"(, "type": "orthographic", "viewWidth": 8)", {1.5, 1.0, -0.5}, 0.4, 0.1},
        // Float32 has steps of half a unit there.
        {R"("position": [500000, 5400900, 400], "target": [500300, 5400000, 0], "up": [0, 0, 1])",
         {500200.0, 5400100.0, 30.0},
         20.0,
         0.3}};
    for (const Case &one : cases)
        for (const std::string crop : {"", " --crop 40,256,20,180"}) {
            const auto with = [](std::string text, const std::string &key, const std::string &value) {
                return text.replace(text.find(key), key.size(), value);
            };
            const std::string ball = "[" + std::to_string(one.ball.x) + ", " + std::to_string(one.ball.y) +
                                     ", " + std::to_string(one.ball.z) + "]";
            store("scene.json", with(with(with(ballScene, "CAMERA", one.camera), "BALL", ball), "RADIUS",
                                     std::to_string(one.radius)));
            ASSERT_EQ(
                run("render scene.json -o a.exr --integrator ao --ao-distance 1e-3 --sampler centre --spp 1 "
                    "--layers depth --width 256 --height 192 --device cpu --quiet" +
                    crop)
                    .exitCode,
                0);
            const Image depths = readExr(InputFile(folder / "a.exr"), "Z");
            const Imf::InputFile file((folder / "a.exr").c_str());
            const Imath::Box2i data = file.header().dataWindow();
            glm::dvec2 sum(0.0);
            int count = 0;
            for (int y = 0; y < depths.height(); ++y)
                for (int x = 0; x < depths.width(); ++x)
                    if (depths.at(x, y).x < 1e9f) {
                        sum += glm::dvec2(data.min.x + x + 0.5, data.min.y + y + 0.5);
                        ++count;
                    }
            ASSERT_GT(count, 4) << one.camera;
            const Imath::M44d toNdc(Imf::worldToNDC(file.header()));
            const Imath::M44d toCamera(Imf::worldToCamera(file.header()));
            const Imath::V3d point(one.ball.x, one.ball.y, one.ball.z);
            const Imath::V3d ndc = point * toNdc; // rows, divided by w
            const glm::dvec2 wanted(ndc.x * 256.0, ndc.y * 192.0);
            EXPECT_LT(glm::distance(sum / static_cast<double>(count), wanted), one.tolerancePixels)
                << one.camera << crop << ": " << sum.x / count << ", " << sum.y / count << " and " << wanted.x
                << ", " << wanted.y;
            // The nearest point of the ball is its radius nearer, on the axis.
            float nearest = 1e9f;
            for (const glm::vec3 &depth : depths.pixels())
                nearest = std::min(nearest, depth.x);
            EXPECT_NEAR((point * toCamera).z - static_cast<double>(nearest), one.radius,
                        0.1 * one.radius + 1e-7 * 5e6 * (one.radius > 1.0))
                << one.camera;
        }
    store("around.json", R"({"camera": {"type": "panorama"}, "materials": {"m": {"type": "mirror"}},
                             "spheres": [{"centre": [0, 0, 10], "radius": 4, "material": "m"}]})");
    ASSERT_EQ(run("render around.json -o b.exr" + brief).exitCode, 0);
    EXPECT_FALSE(Imf::hasWorldToNDC(Imf::InputFile((folder / "b.exr").c_str()).header()));
}

TEST_F(ExrFiles, AMergedPictureHasTheMatricesToo) {
    const std::string options = " --layers depth" + brief;
    ASSERT_EQ(run("render cat -o a.exr" + options).exitCode, 0);
    for (const char *part : {"1", "2"})
        ASSERT_EQ(
            run(std::string("render cat -o ") + part + ".part --part " + part + "/2" + options).exitCode, 0);
    ASSERT_EQ(run("merge 1.part 2.part -o b.exr --half --exr-compression rle --quiet").exitCode, 0);
    const Imf::InputFile a((folder / "a.exr").c_str());
    const Imf::InputFile b((folder / "b.exr").c_str());
    EXPECT_EQ(Imf::worldToCamera(a.header()), Imf::worldToCamera(b.header()));
    EXPECT_EQ(Imf::worldToNDC(a.header()), Imf::worldToNDC(b.header()));
    EXPECT_EQ(a.header().screenWindowWidth(), b.header().screenWindowWidth());
    EXPECT_EQ(b.header().compression(), Imf::RLE_COMPRESSION);
    EXPECT_EQ(b.header().channels()["R"].type, Imf::HALF);
    EXPECT_EQ(b.header().channels()["Z"].type, Imf::FLOAT);
}

// OpenImageIO is the reader of Blender, Houdini and others.
TEST_F(ExrFiles, OpenImageIoReadsTheSameNumbers) {
    ASSERT_EQ(
        run("render cat -o a.exr --crop 3,20,2,14 --layers normal --half --exr-compression zips" + brief)
            .exitCode,
        0);
    storeWithAlpha("b.exr");
    storeWithAlpha("c.png");
    store("read.py", R"(
import sys
import OpenImageIO as oiio
for name in sys.argv[1:]:
    image = oiio.ImageBuf(name)
    spec, roi = image.spec(), image.roi
    print(name, spec.nchannels, *spec.channelnames, spec.alpha_channel, roi.xbegin, roi.ybegin, spec.full_width,
          spec.full_height, len(spec.getattribute("worldToNDC") or ()), image.nsubimages)
    if "samples.Y" in spec.channelnames:
        index = spec.channelnames.index("samples.Y")
        counts = oiio.ImageInput.open(name).read_image(0, 0, index, index + 1, oiio.UINT32)
        print(counts.dtype, counts.min(), counts.max())
    with open(name + ".floats", "wb") as file:
        file.write(image.get_pixels(oiio.FLOAT).tobytes())
)");
    EXPECT_EQ(printedBy("/usr/bin/python3 read.py a.exr b.exr c.png", "python3-openimageio"),
              "a.exr 10 R G B normal.X normal.Y normal.Z samples.Y variance.R variance.G variance.B -1 3 2 "
              "24 16 16 1\n"
              "uint32 2 2\n"
              "b.exr 4 R G B A 3 0 0 8 4 0 1\n"
              "c.png 4 R G B A 3 0 0 8 4 0 1\n");
    const InputFile file(folder / "a.exr");
    const Image colours = readExr(file);
    const std::vector<std::uint32_t> counts = readExrWhole(file, "samples");
    const std::vector<float> values = floatsIn("a.exr.floats");
    ASSERT_EQ(values.size(), 10 * colours.pixels().size());
    for (std::size_t i = 0; i < colours.pixels().size(); ++i) {
        for (glm::length_t channel = 0; channel < 3; ++channel)
            ASSERT_EQ(values[10 * i + static_cast<std::size_t>(channel)], colours.pixels()[i][channel]);
        ASSERT_EQ(counts[i], 2u);
    }
    const LoadedImage loaded = readImage(folder / "b.exr");
    const std::vector<float> withAlpha = floatsIn("b.exr.floats");
    for (std::size_t i = 0; i < loaded.alpha.size(); ++i) {
        ASSERT_EQ(withAlpha[4 * i + 1], loaded.image.pixels()[i].y);
        ASSERT_EQ(withAlpha[4 * i + 3], loaded.alpha[i]);
    }
}

TEST_F(ExrFiles, ImageMagickSeesSizeAndAlpha) {
    storeWithAlpha("a.png");
    storeWithAlpha("b.exr");
    ASSERT_EQ(run("render cat -o c.exr --crop 3,20,2,14" + brief).exitCode, 0);
    EXPECT_EQ(printedBy("/usr/bin/identify -format '%f %w %h %[channels]\\n' a.png b.exr c.exr",
                        "imagemagick and libmagickcore-6.q16-6-extra"),
              "a.png 8 4 srgba\nb.exr 8 4 rgba\nc.exr 24 16 rgba\n")
        << "of a crop the whole picture, and any EXR has alpha there";
    const LoadedImage loaded = readImage(folder / "a.png");
    const std::vector<std::uint8_t> levels = pngLevels(loaded.image, loaded.alpha);
    ASSERT_EQ(printedBy("/usr/bin/convert a.png -depth 8 RGBA:a.rgba", "imagemagick"), "");
    EXPECT_TRUE(load("a.rgba") == std::string(levels.begin(), levels.end()));
}

TEST_F(ExrFiles, AlphaIsKeptByTonemapAndComparedByDiff) {
    storeWithAlpha("a.exr");
    storeWithAlpha("b.exr", 0.5f);
    ASSERT_EQ(run("tonemap a.exr a.png").exitCode, 0);
    storeWithAlpha("wanted.png");
    EXPECT_EQ(run("diff a.png wanted.png").exitCode, 0);
    EXPECT_EQ(readImage(folder / "a.png").alpha.size(), 32u);
    EXPECT_EQ(run("diff a.exr a.exr").exitCode, 0);
    EXPECT_FALSE(contains(run("diff a.exr wanted.png --max-diff 0").output, "FAILED")) << "as the PNG has it";
    const Outcome different = run("diff a.exr b.exr --report report.json");
    EXPECT_EQ(different.exitCode, 1);
    EXPECT_TRUE(contains(different.output,
                         "alpha        28 (87.5 %) pixels differ; largest 0.5 at (7, 0), mean 0.25; "
                         "colours are compared over black"))
        << different;
    EXPECT_EQ(nlohmann::json::parse(load("report.json")).at("alpha").at("maxDifference"), 0.5);
    EXPECT_EQ(run("diff a.exr b.exr --max-diff 0.5").exitCode, 0);
    EXPECT_EQ(run("diff a.exr b.exr --max-diff 0.49").exitCode, 1) << "alpha is a channel";
    // Without alpha.
    Image opaque = readImage(folder / "a.exr").image;
    AtomicFile file(folder / "opaque.exr");
    writeImage(file, ImageFormat::Exr, opaque, 0.0);
    file.commit();
    const Outcome against = run("diff a.exr opaque.exr");
    EXPECT_EQ(against.exitCode, 1);
    EXPECT_TRUE(contains(against.output, "opaque.exr has none, and counts as opaque")) << against;
}

TEST_F(ExrFiles, OptionsAreThoseOfAnExr) {
    for (const std::string option : {"--half", "--exr-compression piz"}) {
        const std::string word = option.substr(0, option.find(' '));
        expectFailure("render cat -o a.png " + option, 2, {word, ".exr", "a.png"});
        expectFailure("render cat -o a.part --part 1/2 " + option, 2, {"--part", word});
        expectFailure("merge a.part -o a.hdr " + option, 2, {word, ".exr", "a.hdr"});
    }
    expectFailure("render cat -o a.exr --exr-compression zipp", 2,
                  {"--exr-compression", "zipp", "\"zip\"", "dwab"});
    EXPECT_TRUE(entries().empty());
}

TEST_F(ExrFiles, WhatTheFileLosesIsAWarning) {
    store("bright.json", R"({"background": [1e6, 0, 0], "spheres": []})");
    const Outcome half =
        run("render bright.json -o a.exr --half --width 4 --height 4 --spp 2 --device cpu --quiet");
    EXPECT_EQ(half.exitCode, 0) << half;
    EXPECT_TRUE(contains(half.errors, "a.exr: 16 values are beyond 65504")) << half;
    EXPECT_EQ(readExr(InputFile(folder / "a.exr")).at(0, 0), glm::vec3(65504.0f, 0.0f, 0.0f));
    const Outcome lossy = run("render cat -o b.exr --exr-compression dwaa --layers normal,depth" + brief);
    EXPECT_EQ(lossy.exitCode, 0) << lossy;
    EXPECT_TRUE(contains(lossy.errors,
                         "b.exr: the compression dwaa is lossy: besides colours it changes variance, normal"))
        << lossy;
}

TEST_F(ExrFiles, FramesOfASequenceAreKnownAsTheyAreStored) {
    for (const std::string options : {" --half", " --exr-compression dwaa"}) {
        const std::string command =
            "render spheres --turntable 2 -o turn.#.exr --width 16 --height 12 --spp 2 "
            "--device cpu --resume" +
            options;
        ASSERT_EQ(run(command).exitCode, 0);
        const Outcome again = run(command);
        EXPECT_TRUE(contains(again.output, "turn.0.exr: frame 0 is finished")) << again;
        EXPECT_TRUE(contains(again.output, "turn.1.exr: frame 1 is finished")) << again;
    }
    // Stored otherwise they are other files.
    EXPECT_FALSE(
        contains(run("render spheres --turntable 2 -o turn.#.exr --width 16 --height 12 --spp 2 --device cpu "
                     "--resume")
                     .output,
                 "is finished"));
}

} // namespace
} // namespace hyalite::core::testing
