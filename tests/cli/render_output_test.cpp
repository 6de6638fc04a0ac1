// The files that a render writes: their formats and sizes, and that they appear whole or not at all.
#include "host/image/exr.h"
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"
#include "tests/cli/exr_channels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

using RenderOutput = CommandLine;

const std::string smallWritten = " --width 16 --height 12 --spp 1 --device cpu";
/// Hours of work: whoever begins with it is found out by the clock.
const std::string endlessWritten = " --width 2048 --height 2048 --spp 65536 --device cpu";
constexpr double promptSeconds = 5.0;

TEST_F(RenderOutput, APngIsEncodedForTheScreen) {
    ASSERT_EQ(run("render spheres -o a.png --width 17 --height 11 --spp 1").exitCode, 0);
    const LoadedImage loaded = readImage(folder / "a.png");
    EXPECT_EQ(loaded.encoding, Encoding::Display);
    EXPECT_EQ(loaded.image.width(), 17);
    EXPECT_EQ(loaded.image.height(), 11);
}

TEST_F(RenderOutput, APfmIsLinear) {
    ASSERT_EQ(run("render spheres -o a.pfm --width 17 --height 11 --spp 1").exitCode, 0);
    const LoadedImage loaded = readImage(folder / "a.pfm");
    EXPECT_EQ(loaded.encoding, Encoding::Linear);
    EXPECT_EQ(loaded.image.width(), 17);
    EXPECT_EQ(loaded.image.height(), 11);
    EXPECT_EQ(load("a.pfm").substr(0, 3), "PF\n");
}

TEST_F(RenderOutput, ThePngIsThePfmWithGamma) {
    ASSERT_EQ(run("render spheres -o a.png" + smallWritten).exitCode, 0);
    const Image linear = renderImage("spheres" + smallWritten);
    const Image display = readImage(folder / "a.png").image;
    ASSERT_EQ(linear.pixels().size(), display.pixels().size());
    for (std::size_t i = 0; i < linear.pixels().size(); ++i)
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            const double wanted =
                255.0 * std::clamp(std::pow(double{linear.pixels()[i][channel]}, 1.0 / 2.2), 0.0, 1.0);
            EXPECT_NEAR(255.0 * double{display.pixels()[i][channel]}, wanted, 0.501) << i;
        }
}

TEST_F(RenderOutput, AnExrHasTheLinearColoursAndLayers) {
    ASSERT_EQ(run("render spheres -o a.exr --spp 2 --width 16 --height 12 --device cpu").exitCode, 0);
    const std::string bytes = load("a.exr");
    EXPECT_EQ(bytes.substr(0, 4), "\x76\x2f\x31\x01");
    for (const char *part :
         {"variance.R", "samples", "render spheres -o a.exr", "spheres.json", "hyalite 0."})
        EXPECT_TRUE(contains(bytes, part)) << part;
}

TEST_F(RenderOutput, LayersAreTheViews) {
    const std::string size = " --width 24 --height 18 --device cpu --quiet";
    ASSERT_EQ(
        run("render cat -o a.exr --spp 2 --layers id,albedo,normal,depth,id,ao,uv --ao-distance 3" + size)
            .exitCode,
        0);
    const InputFile file(folder / "a.exr");
    const auto expectSame = [&](const std::string &layer, const std::string &options) {
        const Image wanted =
            renderImage("cat --integrator " + layer + options + " --width 24 --height 18 --device cpu");
        const Image found = readExr(file, layer);
        ASSERT_EQ(found.pixels().size(), wanted.pixels().size());
        for (std::size_t i = 0; i < found.pixels().size(); ++i)
            ASSERT_EQ(found.pixels()[i], wanted.pixels()[i]) << layer << ", pixel " << i;
    };
    expectSame("albedo", " --spp 2");
    expectSame("id", " --spp 1 --sampler centre");
    expectSame("ao", " --spp 2 --ao-distance 3");
    EXPECT_TRUE(hasExrLayer(file, "normal"));
    EXPECT_TRUE(hasExrLayer(file, "Z")) << "the depth, as compositors know it";
    for (const char *channel : {"normal.X", "normal.Y", "normal.Z", "uv.U", "uv.V"})
        EXPECT_TRUE(contains(load("a.exr"), channel)) << channel;
    // The image is the one without layers.
    ASSERT_EQ(run("render cat -o b.exr --spp 2" + size).exitCode, 0);
    EXPECT_TRUE(std::ranges::equal(readExr(file).pixels(), readExr(InputFile(folder / "b.exr")).pixels()));
}

TEST_F(RenderOutput, TheLayerOfDepthsIsPlanar) {
    store("square.obj", squareObj());
    for (const std::string camera : {R"("position": [0, 0, 10], "horizontalFov": 30)",
                                     R"("position": [0, 0, 10], "horizontalFov": 30, "aperture": 2)",
                                     R"("position": [0, 0, 10], "type": "orthographic", "viewWidth": 5)"}) {
        store("square.json", R"({"camera": {)" + camera + R"(}, "materials": {"m": {"type": "mirror"}},
                                "meshes": [{"file": "square.obj", "material": "m"}]})");
        ASSERT_EQ(
            run("render square.json -o a.exr --spp 2 --layers depth --width 24 --height 18 --device cpu")
                .exitCode,
            0);
        int hitCount = 0;
        const Image depths = readExr(InputFile(folder / "a.exr"), "depth");
        for (const glm::vec3 &pixel : depths.pixels()) {
            if (pixel.x == 1e10f)
                continue;
            EXPECT_NEAR(pixel.x, 10.0f, 1e-5f) << camera;
            ++hitCount;
        }
        EXPECT_GT(hitCount, 20) << camera;
        EXPECT_LT(hitCount, 400) << camera;
        for (const char *part : {"1/2", "2/2"})
            ASSERT_EQ(run("render square.json -o " + std::string(part).substr(0, 1) + ".part --part " + part +
                          " --spp 2 --layers depth --width 24 --height 18 --device cpu")
                          .exitCode,
                      0);
        ASSERT_EQ(run("merge 1.part 2.part -o merged.exr").exitCode, 0);
        EXPECT_TRUE(readExr(InputFile(folder / "merged.exr"), "depth").pixels() == depths.pixels());
        std::filesystem::remove(folder / "1.part");
        std::filesystem::remove(folder / "2.part");
    }
    // In a panorama there is no plane: distances.
    store("around.json",
          R"({"camera": {"type": "panorama", "position": [0, 0, 10]}, "materials": {"m": {"type": "mirror"}},
                            "spheres": [{"centre": [0, 0, 10], "radius": 4, "material": "m"}]})");
    ASSERT_EQ(run("render around.json -o b.exr --spp 1 --layers depth --width 24 --height 18 --device cpu")
                  .exitCode,
              0);
    const Image distances = readExr(InputFile(folder / "b.exr"), "depth");
    for (const glm::vec3 &pixel : distances.pixels())
        EXPECT_NEAR(pixel.x, 4.0f, 1e-4f);
}

// Twice the distance of a mirror, and the colour of what it shows: means of all samples, the lens included.
TEST_F(RenderOutput, LayersLookThroughMirrors) {
    store("mirror.json", R"({"camera": {"position": [0, 0, 0], "target": [0, 0, -1], "horizontalFov": 0.1},
        "materials": {"mirror": {"type": "mirror"}, "wall": {"type": "diffuse", "albedo": [0.2, 0.5, 0.7]}},
        "shapes": [{"type": "quad", "material": "mirror", "transform": [{"scale": 8}, {"translate": [0, 0, -3]}]},
                   {"type": "quad", "material": "wall",
                    "transform": [{"scale": 8}, {"rotateDegrees": [0, 180, 0]}, {"translate": [0, 0, 2]}]}]})");
    const std::string small = " --spp 4 --width 8 --height 6 --device cpu --layers albedo,normal,depth";
    const auto pixelsOf = [&](const std::string &file, const std::string &layer) {
        return std::vector<glm::vec3>(readExr(InputFile(folder / file), layer).pixels());
    };
    for (const std::string integrator : {"path", "whitted"}) {
        ASSERT_EQ(
            run("render mirror.json -o a.exr --layers-through --integrator " + integrator + small).exitCode,
            0);
        for (const glm::vec3 &pixel : pixelsOf("a.exr", "albedo"))
            EXPECT_EQ(pixel, glm::vec3(0.2f, 0.5f, 0.7f));
        for (const glm::vec3 &pixel : pixelsOf("a.exr", "depth"))
            EXPECT_NEAR(pixel.x, 8.0f, 1e-5f);
        const auto channels = channelsOf(folder / "a.exr");
        for (const float z : channels.at("normal.Z"))
            EXPECT_NEAR(z, -1.0f, 1e-6f) << "towards the mirror";
    }
    ASSERT_EQ(run("render mirror.json -o b.exr --layers-through --max-depth 1" + small).exitCode, 0);
    for (const glm::vec3 &pixel : pixelsOf("b.exr", "albedo"))
        EXPECT_EQ(pixel, glm::vec3(1.0f)) << "of the mirror, where paths end";
    expectFailure("render mirror.json -o a.exr --layers-through --layers id", 2,
                  {"--layers-through: has no effect", "normal, depth, albedo"});
    ASSERT_EQ(run("render mirror.json -o c.pfm --integrator albedo --layers-through --max-depth 2 --spp 1 "
                  "--width 2 --height 2 --device cpu")
                  .exitCode,
              0);
    expectFailure("render mirror.json -o c.pfm --integrator albedo --max-depth 2", 2, {"--max-depth"});
}

TEST_F(RenderOutput, LayersThatCannotBeAreRefused) {
    expectFailure("render cat -o a.png --layers albedo", 2, {"--layers", ".exr", "a.png"});
    expectFailure("render cat -o a.exr --layers albedo,normals", 2,
                  {"--layers", "normals", "normal", "depth"});
    expectFailure("render cat -o a.exr --layers cost", 2, {"--layers", "cost", "albedo"});
    EXPECT_TRUE(entries().empty());
}

TEST_F(RenderOutput, AnHdrIsWritten) {
    ASSERT_EQ(run("render spheres -o a.hdr" + smallWritten).exitCode, 0);
    EXPECT_TRUE(contains(load("a.hdr"), "\n\n-Y 12 +X 16\n"));
}

TEST_F(RenderOutput, AFullDiskLeavesTheOldFileWhateverTheFormat) {
    for (const char *name : {"a.exr", "a.hdr"}) {
        store(name, "old");
        Surroundings full;
        full.fileSizeLimitBytes = 256;
        const Outcome outcome = runIn(full, "render spheres -o " + std::string(name) + smallWritten);
        EXPECT_EQ(outcome.exitCode, 7) << outcome;
        EXPECT_TRUE(contains(outcome.errors, name)) << outcome;
        EXPECT_EQ(load(name), "old");
    }
    EXPECT_EQ(entries(), (std::set<std::string>{"a.exr", "a.hdr"}));
}

TEST_F(RenderOutput, TheExtensionMayBeInUpperCase) {
    EXPECT_EQ(run("render spheres -o A.PNG" + smallWritten).exitCode, 0);
    EXPECT_EQ(run("render spheres -o A.Pfm" + smallWritten).exitCode, 0);
    EXPECT_EQ(entries(), (std::set<std::string>{"A.PNG", "A.Pfm"}));
}

TEST_F(RenderOutput, EverySizeIsRenderedAlikeOnDeviceAndCpu) {
    const std::string device = " --device " + softwareDevice();
    for (const char *size : {"1 --height 1", "1 --height 40", "40 --height 1", "33 --height 21"}) {
        const std::string line = std::string("spheres --spp 2 --width ") + size;
        const std::string bytes = renderPfm(line + device);
        EXPECT_FALSE(bytes.empty());
        EXPECT_EQ(bytes, renderPfm(line + " --device cpu")) << size;
    }
}

TEST_F(RenderOutput, ACropIsThatPartOfTheImage) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const std::string line = "spheres --width 16 --height 12 --spp 2 --device " + device;
        const Image whole = renderImage(line);
        const Image part = renderImage(line + " --crop 3,9,2,7");
        ASSERT_EQ(whole.width(), 16);
        ASSERT_EQ(part.width(), 6);
        ASSERT_EQ(part.height(), 5);
        for (int y = 0; y < part.height(); ++y)
            for (int x = 0; x < part.width(); ++x)
                EXPECT_EQ(part.at(x, y), whole.at(x + 3, y + 2)) << device << ": " << x << ", " << y;
    }
}

TEST_F(RenderOutput, ACropOfAllIsTheImage) {
    EXPECT_EQ(renderPfm("spheres" + smallWritten), renderPfm("spheres --crop 0,16,0,12" + smallWritten));
}

TEST_F(RenderOutput, ACropThatIsEmptyOrOutsideIsRefused) {
    for (const char *crop : {"0,0,0,12", "5,4,0,12", "0,17,0,12", "0,16,0,13", "-1,16,0,12", "16,17,0,12"})
        expectFailure("render spheres -o a.png --crop " + std::string(crop) + smallWritten, 2,
                      {"--crop", crop, "16", "12"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderOutput, ASmallCropOfAHugeImageNeedsLittleMemory) {
    const Image image = renderImage("spheres --width 32768 --height 32768 --spp 1 --crop 0,4,32764,32768");
    EXPECT_EQ(image.width(), 4);
    EXPECT_EQ(image.height(), 4);
}

TEST_F(RenderOutput, AnImageThatIsTooLargeForItsFormatIsRefusedBeforeRendering) {
    const Outcome outcome = run("render spheres -o a.png --width 32768 --height 32768 --device cpu");
    EXPECT_EQ(outcome.exitCode, 5) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "32768")) << outcome;
    EXPECT_LT(outcome.seconds, promptSeconds);
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderOutput, AFilmThatMemoryCannotHoldIsRefusedWithNumbers) {
    // 76 GiB: machines that have them render for hours and are left out.
    std::ifstream stream("/proc/meminfo");
    std::string key;
    std::uint64_t kibibytes = 0;
    while (key != "MemTotal:" && stream >> key >> kibibytes)
        stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (kibibytes > 0 && kibibytes < 70'000'000) {
        const Outcome refused = run("render spheres -o a.pfm --width 32768 --height 32768 --device cpu");
        EXPECT_EQ(refused.exitCode, 5) << refused;
        for (const char *part : {"32768x32768", "76.0 GiB", "--crop"})
            EXPECT_TRUE(contains(refused.errors, part)) << refused;
    }
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderOutput, AnImageLargerThanADeviceAllowsIsRenderedInPartsOrRefusedWithARemedy) {
    // Vulkan promises storage buffers of 128 MiB: less than a film of this size.
    store("empty.json", "{}");
    const Outcome outcome =
        run("render empty.json -o a.png --width 2200 --height 2000 --spp 1 --device " + softwareDevice());
    if (outcome.exitCode != 0) {
        EXPECT_EQ(outcome.exitCode, 5) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "--crop") || contains(outcome.errors, "--device cpu"))
            << outcome;
    }
}

TEST_F(RenderOutput, AnExistingFileIsReplacedWhole) {
    store("a.png", std::string(1'000'000, 'x'));
    ASSERT_EQ(run("render spheres -o a.png" + smallWritten).exitCode, 0);
    EXPECT_EQ(readImage(folder / "a.png").image.width(), 16);
    EXPECT_EQ(entries(), std::set<std::string>{"a.png"});
}

TEST_F(RenderOutput, ALinkStaysALink) {
    store("real.png", "old");
    fs::create_symlink("real.png", folder / "link.png");
    ASSERT_EQ(run("render spheres -o link.png" + smallWritten).exitCode, 0);
    EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
    EXPECT_EQ(readImage(folder / "real.png").image.width(), 16);
}

TEST_F(RenderOutput, TheOldFileSurvivesARenderThatFails) {
    store("a.png", "old");
    store("bad.json", R"({"camera": 3})");
    expectFailure("render bad.json -o a.png", 3);
    expectFailure("render spheres -o a.png --device nonesuch", 4);
    expectFailure("render spheres -o a.png --spp 0", 2);
    expectFailure("render spheres -o a.png --crop 0,0,0,0", 2);
    expectFailure("render spheres -o a.png --nonesuch", 2);
    EXPECT_EQ(load("a.png"), "old");
    EXPECT_EQ(entries(), (std::set<std::string>{"a.png", "bad.json"}));
}

TEST_F(RenderOutput, TheOldFileSurvivesAFullDisk) {
    store("a.pfm", "old");
    Surroundings full;
    full.fileSizeLimitBytes = 4096;
    const Outcome outcome =
        runIn(full, "render spheres -o a.pfm --width 64 --height 64 --spp 1 --device cpu");
    EXPECT_EQ(outcome.exitCode, 7) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "a.pfm")) << outcome;
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(load("a.pfm"), "old");
    EXPECT_EQ(entries(), std::set<std::string>{"a.pfm"});
}

TEST_F(RenderOutput, WhatCannotBeWrittenIsRefusedBeforeRendering) {
    store("file", "text");
    fs::create_directory(folder / "folder.png");
    fs::create_symlink("/dev/full", folder / "full.png");
    fs::create_symlink("loop.png", folder / "loop.png");
    const std::set<std::string> before = entries();
    for (const char *output : {"missing/a.png", "folder.png", "file/a.png", "full.png", "loop.png",
                               "/proc/a.png", "folder.png/"}) {
        const Outcome outcome = run("render spheres -o " + std::string(output) + endlessWritten);
        // A name that ends in a slash has no extension: either answer is right.
        EXPECT_TRUE(outcome.exitCode == 7 || (outcome.exitCode == 2 && std::string(output) == "folder.png/"))
            << outcome;
        EXPECT_TRUE(contains(outcome.errors, output)) << outcome;
        EXPECT_LT(outcome.seconds, promptSeconds) << output;
        EXPECT_FALSE(contains(outcome.errors, "device:")) << outcome;
    }
    EXPECT_EQ(entries(), before);
    EXPECT_EQ(load("file"), "text");
}

TEST_F(RenderOutput, AnUnknownExtensionIsRefusedBeforeRendering) {
    for (const char *output : {"a", "a.jpg", ".png", "a.png.txt", "jpg:-", "/dev/full"}) {
        const Outcome outcome = run("render spheres -o " + std::string(output) + endlessWritten);
        EXPECT_EQ(outcome.exitCode, 2) << outcome;
        for (const char *part : {output, ".png", ".pfm"})
            EXPECT_TRUE(contains(outcome.errors, part)) << outcome;
        EXPECT_LT(outcome.seconds, promptSeconds) << output;
    }
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderOutput, AReportThatCannotBeWrittenIsRefusedBeforeRendering) {
    fs::create_directory(folder / "folder.json");
    for (const char *report : {"missing/r.json", "folder.json", "/dev/full"}) {
        const Outcome outcome =
            run("render spheres -o a.png --report " + std::string(report) + endlessWritten);
        EXPECT_EQ(outcome.exitCode, 7) << outcome;
        EXPECT_TRUE(contains(outcome.errors, report)) << outcome;
        EXPECT_LT(outcome.seconds, promptSeconds) << report;
    }
    EXPECT_EQ(entries(), std::set<std::string>{"folder.json"});
}

TEST_F(RenderOutput, ImageAndReportAreNotTheSameFile) {
    expectFailure("render spheres -o a.png --report a.png" + smallWritten, 2, {"a.png"});
    expectFailure("render spheres -o a.png --report ./a.png" + smallWritten, 2, {"a.png"});
    expectFailure("compare spheres --diff a.png --report ./a.png" + smallWritten, 2, {"a.png"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderOutput, TheSceneIsNotReplacedByTheReport) {
    store("own.json", "{}");
    expectFailure("render own.json -o a.png --report ./own.json" + smallWritten, 2, {"own.json"});
    expectFailure("compare own.json --report own.json" + smallWritten, 2, {"own.json"});
    EXPECT_EQ(load("own.json"), "{}");
}

TEST_F(RenderOutput, ARenderThatIsKilledLeavesNothingBehind) {
    store("a.png", "old");
    for (const int signal : {SIGUSR1, SIGKILL}) {
        Surroundings interrupted;
        interrupted.signalAfter = "device:";
        interrupted.signal = signal;
        const Outcome outcome = runIn(interrupted, "render spheres -o a.png" + endlessWritten);
        EXPECT_EQ(outcome.exitCode, 128 + signal) << outcome;
        EXPECT_EQ(outcome.output, "");
        EXPECT_EQ(load("a.png"), "old");
        EXPECT_EQ(entries(), std::set<std::string>{"a.png"}) << "after signal " << signal;
    }
}

TEST_F(RenderOutput, MessagesNeverEndUpInTheImage) {
    // The lowest free descriptor is that of a closed stream: the next file that is opened gets it.
    ASSERT_EQ(run("render spheres -o wanted.pfm" + smallWritten).exitCode, 0);
    for (const bool isErrors : {false, true}) {
        Surroundings closed;
        (isErrors ? closed.errors : closed.output) = Stream::Closed;
        const Outcome outcome = runIn(closed, "render spheres -o a.pfm --report r.json" + smallWritten);
        // Either answer is right: done in silence, or refused for want of a place for the messages.
        if (outcome.exitCode == 0) {
            EXPECT_EQ(load("a.pfm"), load("wanted.pfm")) << (isErrors ? "stderr" : "stdout");
        }
        EXPECT_LT(outcome.exitCode, 128) << outcome;
    }
}

TEST_F(RenderOutput, OutputThatIsLostIsAFailure) {
    Surroundings full;
    full.output = Stream::FullDevice;
    EXPECT_EQ(runIn(full, "devices --json").exitCode, 7);
    EXPECT_EQ(runIn(full, "devices").exitCode, 7);
    EXPECT_EQ(runIn(full, "inspect spheres").exitCode, 7);
    EXPECT_EQ(runIn(full, "--help").exitCode, 7);
    EXPECT_TRUE(contains(runIn(full, "devices").errors, "standard output"));
}

TEST_F(RenderOutput, MessagesThatAreLostStopNoRender) {
    Surroundings full;
    full.errors = Stream::FullDevice;
    EXPECT_EQ(runIn(full, "render spheres -o a.png" + smallWritten).exitCode, 0);
    EXPECT_EQ(runIn(full, "render nonesuch -o b.png").exitCode, 3);
    EXPECT_EQ(entries(), std::set<std::string>{"a.png"});
}

TEST_F(RenderOutput, AFileNameMayHoldAnything) {
    for (const char *output : {"'a b.png'", "'ü.png'", "'%s{}.png'", "./-x.png", "'a\"b.png'"})
        EXPECT_EQ(run("render spheres --report r.json -o " + std::string(output) + smallWritten).exitCode, 0)
            << output;
    EXPECT_EQ(entries(),
              (std::set<std::string>{"a b.png", "ü.png", "%s{}.png", "-x.png", "a\"b.png", "r.json"}));
    EXPECT_EQ(nlohmann::json::parse(load("r.json")).at("output"), "a\"b.png");
}

TEST_F(RenderOutput, AFileNameThatIsNotUnicodeIsReportedToo) {
    const std::string name = "a\xff.png";
    const Outcome outcome = run("render spheres --report r.json -o " + name + smallWritten);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(entries(), (std::set<std::string>{name, "r.json"}));
    EXPECT_TRUE(nlohmann::json::accept(load("r.json")));
}

} // namespace
} // namespace hyalite::core::testing
