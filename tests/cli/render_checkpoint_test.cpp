// Renders that are killed, stopped or cut short go on from their checkpoint to the same image, to the bit.
//
// No test waits for a moment: a render is killed when it has written a checkpoint, or is over before, and either is
// fine.
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <csignal>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

class RenderCheckpoint : public CommandLine {
  protected:
    /// Which file it is: each generation is a new one.
    [[nodiscard]] std::uint64_t fileNumber(const std::string &name) const {
        struct stat status {};
        return stat((folder / name).c_str(), &status) == 0 ? status.st_ino : 0;
    }
    /// Kills the program when it has put `count` new generations in place.
    [[nodiscard]] Surroundings killedAfter(int count, int signal = SIGKILL) const {
        Surroundings surroundings;
        surroundings.signal = signal;
        surroundings.signalWhen = [this, count, seen = 0, last = fileNumber("c")]() mutable {
            const std::uint64_t now = fileNumber("c");
            if (now != 0 && now != last) {
                last = now;
                ++seen;
            }
            return seen >= count;
        };
        return surroundings;
    }
    [[nodiscard]] nlohmann::json report() const { return nlohmann::json::parse(load("report.json")); }
};

const std::string smallResumed = " --width 24 --height 16 --spp 3";
const std::string files = " -o a.pfm --report report.json --checkpoint c";

TEST_F(RenderCheckpoint, IsOfOneRenderAtATime) {
    const std::string line = "render spheres" + smallResumed + files + " --device cpu";
    const std::string lock = "hyalite checkpoint lock of process 4711\n";
    store("c.lock", lock); // left over: its process is gone
    EXPECT_EQ(run(line).exitCode, 0);
    EXPECT_FALSE(entries().contains("c.lock"));
    const std::string before = load("c");
    store("c.lock", lock);
    const int descriptor = open((folder / "c.lock").c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(flock(descriptor, LOCK_EX | LOCK_NB), 0);
    expectFailure(line, 7, {"c: another render (process 4711) writes this checkpoint", "name another one"});
    EXPECT_EQ(load("c"), before);
    close(descriptor);
    EXPECT_EQ(run(line + " --resume").exitCode, 0);
    expectFailure("render spheres -o c.lock.pfm --report c.lock --checkpoint c" + smallResumed, 2,
                  {"name the same file"});
    for (const char *report : {"c.part.lock", "c.part.1"})
        expectFailure("render spheres -o c.part --part 1/2 --report " + std::string(report) + smallResumed, 2,
                      {"name the same file"});
}

TEST_F(RenderCheckpoint, LeavesFilesOfOthersAlone) {
    const std::string line = "render spheres -o a.pfm --device cpu" + smallResumed;
    for (const std::string &text :
         {std::string("content-hash = 1\n"), std::string("4711\n"), std::string()}) {
        store("poetry.lock", text);
        expectFailure(line + " --checkpoint poetry", 7,
                      {"'poetry.lock'", "no render made it", "name another"});
        EXPECT_EQ(load("poetry.lock"), text);
    }
    store("precious", "hyalite checkpoint lock of process 4711\n");
    fs::create_hard_link(folder / "precious", folder / "hard.lock");
    fs::create_symlink("precious", folder / "soft.lock");
    fs::create_symlink("nowhere", folder / "loose.lock");
    fs::create_directory(folder / "folder.lock");
    for (const std::string name : {"hard", "soft", "loose", "folder"})
        expectFailure(line + " --checkpoint " + name, 7, {name + ".lock", "name another"});
    EXPECT_EQ(load("precious"), "hyalite checkpoint lock of process 4711\n");
    for (const std::string name : {"d", "d.1"}) {
        store(name, "mine");
        expectFailure(line + " --checkpoint d", 7, {"'" + name + "'", "not a checkpoint"});
        EXPECT_EQ(load(name), "mine");
        fs::remove(folder / name);
    }
    store("d.part", "mine");
    expectFailure("render spheres --part 1/1 -o d.part" + smallResumed, 7, {"'d.part'", "not a checkpoint"});
    EXPECT_EQ(load("d.part"), "mine");
    EXPECT_FALSE(entries().contains("a.pfm"));
}

TEST_F(RenderCheckpoint, AKilledRenderGoesOnToTheSameImage) {
    // A second or so, in which hundreds of checkpoints are written.
    for (const std::string &device : {std::string("cpu"), softwareDevice()}) {
        const std::string line = "spheres --width 96 --height 64 --spp 192 --device " + device;
        const nlohmann::json whole = renderReport(line);
        const std::string wanted = load("reported.pfm");
        std::int64_t samplesBefore = 0;
        int killCount = 0;
        for (int run = 0;; ++run) {
            // In the end without a kill, as a machine may be too slow for one after the first checkpoint.
            const Surroundings surroundings = run < 4 ? killedAfter(1 + run % 3) : Surroundings{};
            const Outcome outcome =
                runIn(surroundings, "render " + line + files + " --checkpoint-interval 1e-3 --resume");
            killCount += outcome.exitCode == 128 + SIGKILL ? 1 : 0;
            const std::set<std::string> there = entries();
            for (const std::string &name : there)
                EXPECT_FALSE(name.ends_with(".tmp")) << name;
            if (outcome.exitCode == 0) {
                const nlohmann::json last = report();
                EXPECT_EQ(last.at("rays"), whole.at("rays"));
                EXPECT_EQ(last.at("finished"), whole.at("finished"));
                if (killCount > 0) {
                    EXPECT_GE(last.at("resumed").at("samples").get<std::int64_t>(), samplesBefore);
                    EXPECT_LE(last.at("resumed").at("rays").at("total"), whole.at("rays").at("total"));
                }
                break;
            }
            ASSERT_EQ(outcome.exitCode, 128 + SIGKILL) << outcome;
            EXPECT_TRUE(there.contains("c") || there.contains("c.1"));
            EXPECT_FALSE(there.contains("a.pfm"));
        }
        EXPECT_GT(killCount, 0) << "it is over before its first checkpoint";
        EXPECT_EQ(load("a.pfm"), wanted) << device;
        for (const std::string &name : entries())
            fs::remove(folder / name);
    }
}

TEST_F(RenderCheckpoint, AStoppedRenderGoesOnFromAllThatItHad) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const std::string line = "render spheres --width 64 --height 64 --spp 16384 --device cpu";
        Surroundings surroundings;
        surroundings.signalWhen = [this] { return fs::exists(folder / "c"); };
        surroundings.signal = signal;
        const Outcome outcome = runIn(surroundings, line + files);
        EXPECT_EQ(outcome.exitCode, 128 + signal) << outcome;
        const nlohmann::json first = report();
        const Outcome next = run(line + files + " --resume" + atOnce);
        EXPECT_EQ(next.exitCode, 0) << next;
        EXPECT_TRUE(contains(next.errors, "resuming from c:")) << next;
        EXPECT_TRUE(contains(next.output, "resumed,")) << next;
        const nlohmann::json second = report();
        EXPECT_EQ(second.at("resumed").at("samples"), first.at("finished").at("samples"));
        EXPECT_EQ(second.at("resumed").at("rays"), first.at("rays"));
        EXPECT_GT(second.at("finished").at("samples"), first.at("finished").at("samples"));
    }
}

TEST_F(RenderCheckpoint, ItGoesOnWithAnotherDeviceThreadsKernelAndTree) {
    store("sheet.obj", wavySheetObj(12));
    store("sheet.json", wavySheetScene());
    const std::string line = "sheet.json --width 300 --height 280 --spp 3";
    const std::string wanted = renderPfm(line + " --device cpu");
    const std::string software = " --device " + softwareDevice();
    const std::vector<std::string> ways{" --device cpu --threads 1", software,
                                        software + " --kernel stack --threads 1",
                                        " --device cpu --threads 3 --bvh sah --leaf-size 2"};
    for (std::size_t way = 0; way < ways.size(); ++way) {
        fs::remove(folder / "c");
        ASSERT_EQ(run("render " + line + files + ways[way] + atOnce).exitCode, 0);
        EXPECT_EQ(report().at("finished").at("isComplete"), false);
        const std::string &other = ways[(way + 1) % ways.size()];
        const Outcome outcome = run("render " + line + files + other + " --resume");
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_EQ(load("a.pfm"), wanted) << ways[way] << " and then" << other;
    }
}

TEST_F(RenderCheckpoint, AFinishedOneMayGetMoreSamples) {
    const std::string line = "render spheres --device cpu --width 24 --height 16" + files;
    ASSERT_EQ(run(line + " --spp 3").exitCode, 0);
    ASSERT_EQ(run(line + " --spp 5 --resume").exitCode, 0);
    EXPECT_EQ(report().at("resumed").at("samples"), 24 * 16 * 3);
    EXPECT_EQ(load("a.pfm"), renderPfm("spheres --device cpu --width 24 --height 16 --spp 5"));
    const Outcome again = run(line + " --spp 5 --resume");
    EXPECT_EQ(again.exitCode, 0) << again;
    EXPECT_TRUE(contains(again.errors, "100.0 %")) << again;
    EXPECT_TRUE(contains(again.output, " 0 rays in")) << again;
    EXPECT_EQ(report().at("finished").at("isComplete"), true);
    expectFailure(line + " --spp 4 --resume", 3, {"samples per pixel: up to 5 there, 4 here"});
}

TEST_F(RenderCheckpoint, AnotherRendersIsRefusedWithWhatDiffers) {
    store("square.obj", squareObj());
    store("square.json", squareScene());
    const std::string line = "render square.json --device cpu" + smallResumed + files;
    ASSERT_EQ(run(line).exitCode, 0);
    const std::string picture = load("a.pfm");
    const std::string checkpoint = load("c");
    for (const auto &[option, difference] : std::vector<std::pair<std::string, std::string>>{
             {"--seed 5", "seed: 0 there, 5 here"},
             {"--max-depth 3", "maxDepth: 7 there, 3 here"},
             {"--sampler sobol", "sampler: centre there, sobol here"},
             {"--width 25", "image: 24x16 there, 25x16 here"},
             {"--crop 0,4,0,4", "crop: 0,24,0,16 there, 0,4,0,4 here"},
             {"--fov 31", "scene and camera: "},
             {"--background 0,0,1", "scene and camera: "}}) {
        std::string changed = line + " --resume ";
        if (const std::size_t width = changed.find("--width 24 "); option.starts_with("--width"))
            changed.erase(width, std::string("--width 24 ").size());
        const std::string message = expectFailure(changed + option, 3, {"'c'", difference});
        EXPECT_TRUE(contains(message, "--resume")) << message;
    }
    store("square.obj", squareObj() + "v 0 0 1\nf 1 2 5\n");
    expectFailure(line + " --resume", 3, {"scene and camera: "});
    EXPECT_EQ(load("a.pfm"), picture);
    EXPECT_EQ(load("c"), checkpoint);
}

TEST_F(RenderCheckpoint, ADamagedOneFallsBackToTheOlderAndSaysSo) {
    const std::string line = "render spheres --device cpu" + smallResumed + files;
    ASSERT_EQ(run(line + atOnce).exitCode, 0);
    ASSERT_EQ(run(line + " --resume").exitCode, 0);
    EXPECT_TRUE(entries().contains("c.1"));
    const std::string wanted = load("a.pfm");
    std::string bytes = load("c");
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    for (const std::string &damaged : {bytes, bytes.substr(0, 100), std::string()}) {
        store("c", damaged);
        const Outcome outcome = run(line + " --resume --quiet");
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_TRUE(contains(outcome.errors, "c: ") && contains(outcome.errors, "older c.1")) << outcome;
        EXPECT_EQ(load("a.pfm"), wanted);
        EXPECT_EQ(report().at("resumed").at("checkpoint"), "c.1");
    }
    store("c", "x");
    store("c.1", "y");
    expectFailure(line + " --resume", 3, {" c: ", " c.1: "});
}

TEST_F(RenderCheckpoint, WithoutOneItBeginsAnewAndSaysSo) {
    const Outcome outcome = run("render spheres --device cpu --resume" + smallResumed + files);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "no checkpoint c yet")) << outcome;
    EXPECT_EQ(report().at("resumed"), nullptr);
}

TEST_F(RenderCheckpoint, WhatCannotBeAskedForIsRefused) {
    expectFailure("render spheres -o a.png --resume", 2, {"--checkpoint"});
    expectFailure("render spheres -o a.png --checkpoint-interval 5", 2, {"--checkpoint FILE"});
    expectFailure("render spheres -o a.png --checkpoint c --device cpu-double", 2, {"cpu-double"});
    expectFailure("render spheres -o a.png --checkpoint a.png", 2, {"same file"});
    expectFailure("render spheres -o c.1 --checkpoint c", 2);
    for (const char *interval : {"0", "-1", "nan", "x"})
        expectFailure("render spheres -o a.png --checkpoint c --checkpoint-interval " + std::string(interval),
                      2, {"--checkpoint-interval"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderCheckpoint, WhatCannotBeWrittenIsRefusedBeforeRendering) {
    fs::create_directory(folder / "folder");
    fs::create_directory(folder / "half.1");
    for (const char *checkpoint : {"missing/c", "folder", "half", "/dev/full"}) {
        const Outcome outcome = run("render spheres -o a.png --device cpu --width 2048 --height 2048 --spp "
                                    "65536 --checkpoint " +
                                    std::string(checkpoint));
        EXPECT_EQ(outcome.exitCode, 7) << outcome;
        EXPECT_TRUE(contains(outcome.errors, checkpoint)) << outcome;
    }
    EXPECT_EQ(entries(), (std::set<std::string>{"folder", "half.1"}));
}

TEST_F(RenderCheckpoint, ADiskThatIsFullStopsNoRender) {
    store("c", "hyalite checkpoint\n, an old one");
    Surroundings full;
    full.fileSizeLimitBytes = 8000; // room for the picture, not for the film
    const Outcome outcome =
        runIn(full, "render spheres --device cpu --checkpoint-interval 1e-3" + smallResumed + files);
    EXPECT_EQ(outcome.exitCode, 7) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "'c'")) << outcome;
    EXPECT_EQ(load("a.pfm"), renderPfm("spheres --device cpu" + smallResumed));
    EXPECT_EQ(load("c"), "hyalite checkpoint\n, an old one");
    EXPECT_EQ(report().at("finished").at("isComplete"), true);
}

} // namespace
} // namespace hyalite::core::testing
