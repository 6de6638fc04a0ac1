// What a render says: the JSON report, the closing line, progress, and silence on request.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <csignal>
#include <regex>
#include <string>

namespace hyalite::core::testing {
namespace {

class RenderReport : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        store("sheet.obj", wavySheetObj(12));
        store("sheet.json", wavySheetScene());
    }
};

const std::string smallReported = " --width 16 --height 12 --spp 2";
/// Seconds of work, in which to watch the progress.
const std::string endlessReported = " --width 64 --height 64 --spp 8192";

std::set<std::string> keysOf(const nlohmann::json &object) {
    std::set<std::string> keys;
    for (const auto &[key, value] : object.items())
        keys.insert(key);
    return keys;
}

TEST_F(RenderReport, HasAllItsKeys) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const nlohmann::json report = renderReport("sheet.json" + smallReported + " --device " + device);
        EXPECT_EQ(
            keysOf(report),
            (std::set<std::string>{"program", "commandLine", "scene", "sceneHash", "output", "device",
                                   "image", "settings", "triangles", "finished", "denoised", "faults",
                                   "resumed", "rays", "noisiest", "dispatches", "deviceBytes", "seconds"}));
        EXPECT_EQ(keysOf(report.at("finished")),
                  (std::set<std::string>{"isComplete", "pixels", "samples", "fewestSamples", "mostSamples",
                                         "noise", "stoppedBy"}));
        std::set<std::string> ofDevice{"name", "driver", "arithmetic", "equalBits"};
        if (device != "cpu")
            ofDevice.insert("kernel");
        EXPECT_EQ(keysOf(report.at("device")), ofDevice);
        EXPECT_EQ(keysOf(report.at("image")), (std::set<std::string>{"width", "height"}));
        EXPECT_EQ(keysOf(report.at("settings")),
                  (std::set<std::string>{"integrator",    "spp",         "maxDepth",    "occlusionDistance",
                                         "bvh",           "leafSize",    "sampler",     "filter",
                                         "seed",          "clamp",       "alpha",       "alphaThroughGlass",
                                         "layersThrough", "lightLayers", "lightGroups", "denoise",
                                         "denoisingData", "exposure",    "lightChoice", "noise"}));
        EXPECT_EQ(keysOf(report.at("rays")), (std::set<std::string>{"primary", "shadow", "reflection",
                                                                    "refraction", "bounce", "total"}));
        EXPECT_EQ(keysOf(report.at("seconds")),
                  (std::set<std::string>{"load", "build", "upload", "pipeline", "render", "denoise", "write",
                                         "total"}));
    }
}

TEST_F(RenderReport, SaysWhatWasAsked) {
    const nlohmann::json report = renderReport("sheet.json --crop 2,7,1,5" + smallReported);
    EXPECT_TRUE(contains(report.at("program"), "hyalite "));
    EXPECT_TRUE(contains(report.at("commandLine"), "render sheet.json --crop 2,7,1,5 --width 16")) << report;
    EXPECT_TRUE(contains(report.at("scene"), "sheet.json"));
    EXPECT_EQ(report.at("output"), "reported.pfm");
    EXPECT_EQ(report.at("image"), (nlohmann::json{{"width", 5}, {"height", 4}}));
    EXPECT_EQ(report.at("triangles"), 2 * 12 * 12);
    EXPECT_EQ(report.at("rays").at("primary"), 5 * 4 * 2);
    EXPECT_EQ(report.at("finished"), (nlohmann::json{{"isComplete", true},
                                                     {"pixels", 5 * 4},
                                                     {"samples", 5 * 4 * 2},
                                                     {"fewestSamples", 2},
                                                     {"mostSamples", 2},
                                                     {"noise", nullptr},
                                                     {"stoppedBy", nullptr}}));
}

/// The text with a keyword in a PNG.
std::string textOf(const std::string &png, const std::string &keyword) {
    const std::string begin = "iTXt" + keyword + std::string(5, '\0');
    const std::size_t at = png.find(begin);
    if (at == std::string::npos)
        return "no " + keyword;
    std::size_t sizeBytes = 0;
    for (std::size_t i = 0; i < 4; ++i)
        sizeBytes = sizeBytes << 8 | static_cast<unsigned char>(png[at - 4 + i]);
    return png.substr(at + begin.size(), sizeBytes + 4 - begin.size());
}

TEST_F(RenderReport, APictureSaysWhatTheReportSays) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        ASSERT_EQ(
            run("render sheet.json -o a.png --report a.json --seed 7 --device " + device + smallReported)
                .exitCode,
            0);
        const nlohmann::json report = nlohmann::json::parse(load("a.json"));
        const std::string png = load("a.png");
        EXPECT_EQ(textOf(png, "Software"), report.at("program").get<std::string>());
        EXPECT_EQ(textOf(png, "settings.seed"), "7");
        EXPECT_EQ(textOf(png, "settings.spp"), "2");
        for (const char *key : {"commandLine", "scene", "sceneHash"})
            EXPECT_EQ(textOf(png, key), report.at(key).get<std::string>()) << key;
        for (const char *key : {"name", "driver", "arithmetic"})
            EXPECT_EQ(textOf(png, std::string("device.") + key),
                      report.at("device").at(key).get<std::string>())
                << key;
        if (device != "cpu") {
            EXPECT_EQ(textOf(png, "device.kernel.spirvHash"),
                      report.at("device").at("kernel").at("spirvHash").get<std::string>());
        }
    }
}

TEST_F(RenderReport, EveryCommandSaysWhereItsFilesComeFrom) {
    const nlohmann::json wanted =
        renderReport("sheet.json" + smallReported + " --device " + softwareDevice());
    ASSERT_EQ(run("compare sheet.json --diff e.png --report compare.json --device " + softwareDevice() +
                  smallReported)
                  .exitCode,
              0);
    ASSERT_EQ(run("profile sheet.json --repeat 1 --no-verify -o p.png --report profile.json --device " +
                  softwareDevice() + smallReported)
                  .exitCode,
              0);
    ASSERT_EQ(run("diff p.png p.png --diff d.png --report diff.json").exitCode, 0);
    const nlohmann::json compare = nlohmann::json::parse(load("compare.json"));
    const nlohmann::json profile = nlohmann::json::parse(load("profile.json"));
    const nlohmann::json diff = nlohmann::json::parse(load("diff.json"));
    for (const char *key : {"program", "scene", "sceneHash", "triangles", "image", "settings"}) {
        EXPECT_EQ(compare.at(key), wanted.at(key)) << key;
        EXPECT_EQ(profile.at(key), wanted.at(key)) << key;
    }
    EXPECT_EQ(compare.at("first"), wanted.at("device"));
    EXPECT_EQ(compare.at("second").at("name"), "cpu");
    EXPECT_EQ(profile.at("device").at("kernel"), wanted.at("device").at("kernel"));
    EXPECT_EQ(diff.at("program"), wanted.at("program"));
    EXPECT_EQ(textOf(load("e.png"), "commandLine"), compare.at("commandLine").get<std::string>());
    EXPECT_EQ(textOf(load("e.png"), "second.name"), "cpu");
    EXPECT_EQ(textOf(load("p.png"), "commandLine"), profile.at("commandLine").get<std::string>());
    EXPECT_EQ(textOf(load("d.png"), "commandLine"), diff.at("commandLine").get<std::string>());
}

TEST_F(RenderReport, NoNameSpoilsAPictureOrAReport) {
    Surroundings surroundings;
    surroundings.folder = folder;
    const std::string name = "a\x1b[31m\xff\r\n\u0085.png";
    ASSERT_EQ(runProgram({"render", "sheet.json", "-o", name, "--width", "4", "--height", "4", "--spp",
                          std::string(100'000, '0') + "1", "--device", "cpu", "--report", "report.json"},
                         surroundings)
                  .exitCode,
              0);
    const nlohmann::json report = nlohmann::json::parse(load("report.json"));
    EXPECT_TRUE(contains(report.at("commandLine"), "a\x1b[31m\uFFFD\r\n"));
    EXPECT_EQ(report.at("settings").at("spp"), 1);
    EXPECT_TRUE(contains(textOf(load(name), "commandLine"), "a\uFFFD[31m\uFFFD\uFFFD\n\uFFFD.png"));
    const Outcome diff = runProgram({"diff", name, name}, surroundings);
    EXPECT_EQ(diff.exitCode, 0) << diff;
}

TEST_F(RenderReport, CommandLineCanBePastedBack) {
    const Outcome outcome =
        run("render sheet.json -o 'a b.pfm' --look-at '0, 0, 0' --quiet --device cpu --report \"it's\"" +
            smallReported);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    const nlohmann::json report = nlohmann::json::parse(load("it's"));
    const std::vector<std::string> words = splitWords(report.at("commandLine").get<std::string>());
    EXPECT_EQ(words.at(4), "a b.pfm") << report.at("commandLine");
    EXPECT_EQ(words.at(6), "0, 0, 0") << report.at("commandLine");
    EXPECT_EQ(words.at(11), "it's") << report.at("commandLine");
}

TEST_F(RenderReport, TheCommandLineIsQuotedAsAShellNeedsIt) {
    for (const char *name : {"#a.pfm", "~a.pfm", "a[b]!.pfm", "a`b$c.pfm", "a\\b.pfm", "'a' \"b\".pfm"}) {
        Surroundings surroundings;
        surroundings.folder = folder;
        const Outcome outcome = runProgram({"render", "sheet.json", "-o", name, "--width", "4", "--spp", "1",
                                            "--device", "cpu", "--report", "report.json"},
                                           surroundings);
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        const nlohmann::json report = nlohmann::json::parse(load("report.json"));
        EXPECT_EQ(splitWords(report.at("commandLine").get<std::string>()).at(4), name) << report;
    }
}

TEST_F(RenderReport, RayCountsAreEqualOnDeviceAndCpu) {
    const std::string software = softwareDevice();
    for (const char *scene : {"sheet.json", "spheres", "spheres-nested"}) {
        const nlohmann::json onCpu = renderReport(scene + smallReported + " --device cpu");
        const nlohmann::json onDevice = renderReport(scene + smallReported + " --device " + software);
        EXPECT_EQ(onCpu.at("rays"), onDevice.at("rays")) << scene;
        const nlohmann::json &rays = onDevice.at("rays");
        EXPECT_EQ(rays.at("primary"), 16 * 12 * 2);
        EXPECT_EQ(rays.at("total").get<long>(),
                  rays.at("primary").get<long>() + rays.at("shadow").get<long>() +
                      rays.at("reflection").get<long>() + rays.at("refraction").get<long>());
        EXPECT_EQ(onCpu.at("triangles"), onDevice.at("triangles"));
        EXPECT_EQ(onCpu.at("settings"), onDevice.at("settings"));
    }
}

TEST_F(RenderReport, TimesAddUp) {
    const nlohmann::json seconds = renderReport("spheres" + smallReported).at("seconds");
    double sum = 0.0;
    for (const auto &[key, value] : seconds.items()) {
        EXPECT_TRUE(value.is_number()) << key;
        EXPECT_GE(value.get<double>(), 0.0) << key;
        sum += key == "total" ? 0.0 : value.get<double>();
    }
    EXPECT_GT(seconds.at("render").get<double>(), 0.0);
    EXPECT_LE(sum, seconds.at("total").get<double>() * 1.001);
}

TEST_F(RenderReport, AnExistingReportIsReplacedWhole) {
    store("report.json", std::string(100'000, 'x'));
    EXPECT_EQ(renderReport("spheres --device cpu" + smallReported).at("output"), "reported.pfm");
}

TEST_F(RenderReport, QuietPrintsErrorsOnly) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const Outcome outcome = run("render spheres -o a.png --quiet --device " + device + smallReported);
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_EQ(outcome.output, "");
        EXPECT_EQ(outcome.errors, "");
    }
    EXPECT_NE(run("render nonesuch -o a.png --quiet").errors, "");
}

TEST_F(RenderReport, QuietIsSilentOnATerminalToo) {
    Surroundings terminal;
    terminal.errors = Stream::Terminal;
    const Outcome outcome =
        runIn(terminal, "render spheres -o a.png --quiet --device cpu --width 128 --height 96 --spp 64");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.errors, "");
}

TEST_F(RenderReport, TheClosingLineSaysSizeSamplesRaysTimeAndSpeed) {
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const Outcome outcome = run("render spheres -o a.png --device " + device + smallReported);
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_TRUE(std::regex_match(
            outcome.output, std::regex("a\\.png: 16x12, 2 spp, [0-9.]+ [kM]?[ ]?rays in [0-9.]+ s: [0-9.]+ "
                                       "Mray/s.*\n")))
            << outcome;
    }
}

TEST_F(RenderReport, TheClosingLineCountsFewRaysOneByOne) {
    const Outcome outcome =
        run("render spheres -o a.png --device cpu --width 4 --height 3 --spp 1 --max-depth 1");
    EXPECT_TRUE(std::regex_search(outcome.output, std::regex(" [0-9]+ rays in "))) << outcome;
}

TEST_F(RenderReport, TheClosingLineHasTheSizeOfTheCrop) {
    const Outcome outcome = run("render spheres -o a.png --device cpu --crop 0,5,0,3" + smallReported);
    EXPECT_TRUE(contains(outcome.output, " 5x3,")) << outcome;
}

TEST_F(RenderReport, AShortRenderShowsNoProgress) {
    const Outcome outcome = run("render spheres -o a.png --device cpu" + smallReported);
    EXPECT_FALSE(contains(outcome.errors, "progress")) << outcome;
}

TEST_F(RenderReport, ProgressInALogIsLinesOfKeysAndValues) {
    Surroundings log;
    log.signalAfter = "left_s=";
    log.signal = SIGTERM;
    const Outcome outcome = runIn(log, "render spheres -o a.png --device cpu" + endlessReported);
    EXPECT_TRUE(std::regex_search(
        outcome.errors,
        std::regex("(^|\n)task=render progress=[01]\\.[0-9]+ elapsed_s=[0-9.]+ left_s=[0-9.]+\n")))
        << outcome;
    EXPECT_FALSE(contains(outcome.errors, "\r")) << outcome;
    EXPECT_LT(outcome.seconds, 15.0);
}

TEST_F(RenderReport, ProgressOnATerminalIsOneLineWithTheTimeLeft) {
    Surroundings terminal;
    terminal.errors = Stream::Terminal;
    const Outcome outcome = runIn(terminal, "render spheres -o a.png --device " + softwareDevice() +
                                                " --width 128 --height 256 --spp 65536 --time-limit 1.5");
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "\r\033[Krender [")) << outcome;
    EXPECT_FALSE(contains(outcome.errors, "\uFFFD")) << outcome;
    EXPECT_TRUE(std::regex_search(outcome.errors, std::regex("[0-9]+ %  .*[0-9]+ (s|min) left"))) << outcome;
    EXPECT_FALSE(contains(outcome.errors, "task=")) << outcome;
    // In the end the line is cleared, and what is left is not a ruin of it.
    EXPECT_GT(outcome.errors.rfind("\r\033[K"), outcome.errors.rfind("left")) << outcome;
    EXPECT_LT(outcome.errors.rfind("\r\033[K"), outcome.errors.size()) << "there is one";
}

} // namespace
} // namespace hyalite::core::testing
