// Renders that are stopped, by signals and by --time-limit: what is finished is written, whole.
//
// No test waits for a moment: a time limit has passed before the first dispatch ends, a signal comes when a checkpoint
// shows that work was finished, and there is far more work than that.
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <string>

namespace hyalite::core::testing {
namespace {

class RenderStop : public CommandLine {
  protected:
    /// Expects the picture of a render that was stopped early, a report that says so, and nothing else in the folder.
    /// Returns what the report says is finished.
    nlohmann::json expectPart(const std::string &picture, int side, const std::string &stoppedBy) const {
        for (const char *checkpoint : {"c", "c.1"})
            std::filesystem::remove(folder / checkpoint);
        EXPECT_EQ(entries(), (std::set<std::string>{picture, "report.json"}));
        const Image image = readImage(folder / picture).image;
        EXPECT_EQ(image.width(), side);
        EXPECT_EQ(image.height(), side);
        EXPECT_GT(litPixelCount(image), 0);
        const Outcome diff = run("diff " + picture + " " + picture);
        EXPECT_EQ(diff.exitCode, 0) << diff;
        const nlohmann::json finished = nlohmann::json::parse(load("report.json")).at("finished");
        EXPECT_EQ(finished.at("isComplete"), false);
        EXPECT_EQ(finished.at("stoppedBy"), stoppedBy);
        EXPECT_LT(finished.at("pixels"), side * side);
        EXPECT_GT(finished.at("samples"), 0);
        return finished;
    }

    /// A signal comes when the checkpoint is there.
    [[nodiscard]] Surroundings signalled(int signal) const {
        Surroundings surroundings;
        surroundings.signalWhen = [this] { return std::filesystem::exists(folder / "c"); };
        surroundings.signal = signal;
        return surroundings;
    }
};

const std::string withCheckpoint = " --checkpoint c --checkpoint-interval 1e-3";

const char *nameOf(int signal) {
    return signal == SIGINT ? "SIGINT" : signal == SIGHUP ? "SIGHUP" : "SIGTERM";
}

/// Hundreds of tiles of a software device, the first one of 32x32 pixels.
const std::string manyTiles = " --width 2048 --height 2048 --spp 4";
/// Hours of work.
const std::string endlessStopped = " --width 512 --height 512 --spp 65536 --device cpu";

TEST_F(RenderStop, ASignalWritesWhatTheDeviceHasFinished) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const Outcome outcome = runIn(
            signalled(signal),
            "render spheres -o a.pfm --report report.json --width 1024 --height 1024 --spp 1024 --device " +
                softwareDevice() + withCheckpoint);
        EXPECT_EQ(outcome.exitCode, 128 + signal) << outcome;
        const nlohmann::json finished = expectPart("a.pfm", 1024, nameOf(signal));
        for (const std::string &part :
             {std::string("stopping"), std::string("stopped by ") + nameOf(signal),
              std::to_string(finished.at("pixels").get<long>()) + " of 1048576 pixels", std::string("a.pfm")})
            EXPECT_TRUE(contains(outcome.errors, part)) << part << '\n' << outcome;
        EXPECT_TRUE(contains(outcome.output, "up to 1024 spp")) << outcome;
        std::filesystem::remove(folder / "report.json");
    }
}

TEST_F(RenderStop, ASignalWritesWhatTheReferenceHasFinished) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Outcome outcome = runIn(signalled(signal), "render spheres -o a.pfm --report report.json" +
                                                             endlessStopped + withCheckpoint);
        EXPECT_EQ(outcome.exitCode, 128 + signal) << outcome;
        EXPECT_LT(outcome.seconds, 20.0);
        expectPart("a.pfm", 512, nameOf(signal));
        std::filesystem::remove(folder / "report.json");
    }
}

/// Balls of glass, each within the next: each sample that meets them is a tree of 2^32 rays, which comes to no end.
std::string glassScene(const std::array<double, 3> &camera, const std::array<double, 3> &target) {
    nlohmann::json scene = {{"materials", {{"glass", {{"type", "dielectric"}, {"index", 1.5}}}}}};
    for (int i = 0; i < 32; ++i)
        scene["spheres"].push_back({{"centre", {0, 0, 0}}, {"radius", 1.0 + 0.2 * i}, {"material", "glass"}});
    scene["camera"] = {{"position", camera}, {"target", target}};
    scene["background"] = {0.1, 0.2, 0.3};
    return scene.dump();
}

TEST_F(RenderStop, BeforeThereIsAnythingToKeepASignalEndsItAtOnce) {
    store("glass.json", glassScene({0.3, 0.2, 0.1}, {0, 0, -5}));
    store("a.png", "old");
    for (const int signal : {SIGINT, SIGTERM}) {
        Surroundings surroundings;
        surroundings.signalAfter = "device:";
        surroundings.signal = signal;
        const Outcome outcome = runIn(surroundings, "render glass.json -o a.png --report report.json "
                                                    "--max-depth 32 --width 64 --height 64 --device cpu");
        EXPECT_EQ(outcome.exitCode, 128 + signal) << outcome;
        EXPECT_EQ(entries(), (std::set<std::string>{"a.png", "glass.json"}));
        EXPECT_EQ(load("a.png"), "old");
    }
}

// One thread sees the background, the other one glass.
TEST_F(RenderStop, ASampleThatComesToNoEndIsAbandoned) {
    store("glass.json", glassScene({0, 0, 40}, {-6, 0, 0}));
    const Outcome outcome = run("render glass.json -o a.pfm --report report.json --max-depth 32 --device cpu "
                                "--threads 2 --width 64 --height 64 --spp 65536 --time-limit 0.5");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    std::filesystem::remove(folder / "glass.json");
    expectPart("a.pfm", 64, "the time limit");
}

TEST_F(RenderStop, QuietSaysOnlyWhatIsMissing) {
    const std::string line = "render spheres -o a.png --report report.json --quiet" + endlessStopped + atOnce;
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.output + outcome.errors, "");
    expectPart("a.png", 512, "the time limit");
}

TEST_F(RenderStop, TilesThatADeviceHasFinishedAreThoseOfTheWholeRender) {
    const std::string device = " --device " + softwareDevice() + manyTiles;
    const std::string firstTile = renderPfm("spheres --crop 0,32,0,32" + device);
    const Image wanted = readImage(folder / "rendered.pfm").image;
    std::filesystem::remove(folder / "rendered.pfm");
    for (const char *kernel : {"auto", "stack"}) {
        const Outcome outcome = run("render spheres -o a.pfm --report report.json --kernel " +
                                    std::string(kernel) + device + atOnce);
        ASSERT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "stopped by the time limit")) << outcome;
        const nlohmann::json finished = expectPart("a.pfm", 2048, "the time limit");
        EXPECT_EQ(finished.at("pixels"), 32 * 32);
        EXPECT_EQ(finished.at("samples"), 32 * 32 * 4);
        const Image image = readImage(folder / "a.pfm").image;
        int differentCount = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                differentCount += image.at(x, y) != wanted.at(x, y);
        EXPECT_EQ(differentCount, 0) << kernel;
        EXPECT_EQ(litPixelCount(image), litPixelCount(wanted)) << "elsewhere it is black";
    }
}

TEST_F(RenderStop, SamplesThatTheReferenceHasFinishedAreThoseOfTheWholeRender) {
    // With one sample a pixel, each is finished or black.
    const std::string line = "spheres --width 512 --height 512 --spp 1 --device cpu";
    const Image whole = renderImage(line);
    std::filesystem::remove(folder / "rendered.pfm");
    const Outcome outcome = run("render -o a.pfm --report report.json " + line + atOnce);
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    const nlohmann::json finished = expectPart("a.pfm", 512, "the time limit");
    EXPECT_EQ(finished.at("pixels"), finished.at("samples"));
    const Image image = readImage(folder / "a.pfm").image;
    int differentCount = 0;
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
        differentCount += image.pixels()[i] != glm::vec3(0.0f) && image.pixels()[i] != whole.pixels()[i];
    EXPECT_EQ(differentCount, 0);
    EXPECT_LE(litPixelCount(image), finished.at("pixels"));
}

TEST_F(RenderStop, ATimeLimitThatSufficesChangesNothing) {
    const std::string line = "spheres --width 32 --height 24 --spp 2";
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const nlohmann::json report = renderReport(line + " --time-limit 1e6 --device " + device);
        EXPECT_EQ(report.at("finished").at("isComplete"), true);
        EXPECT_EQ(report.at("finished").at("stoppedBy"), nullptr);
        EXPECT_EQ(load("reported.pfm"), renderPfm(line + " --device " + device)) << device;
    }
}

TEST_F(RenderStop, TimeLimitsArePositive) {
    for (const char *limit : {"0", "-1", "nan", "x", "1e10"})
        expectFailure("render spheres -o a.png --time-limit " + std::string(limit), 2, {"--time-limit"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

} // namespace
} // namespace hyalite::core::testing
