// Every file that any command writes appears whole or not at all: where it cannot be stored, the one that was there
// before stays, the exit code says so, and no other file is left behind.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hyalite::testing {
namespace {

namespace fs = std::filesystem;

using OutputFiles = CommandLine;

struct Case {
    std::string line; ///< a command that writes `file`, and nothing larger than the limit before
    std::string file;
};

const std::string tiny = " --width 1 --height 1 --spp 1 --device cpu";

std::vector<Case> allFiles() {
    const std::string profile =
        "profile spheres --width 16 --height 16 --spp 1 --repeat 1 --warmup 0 --quiet";
    const std::string render = "render spheres --width 64 --height 64 --spp 1 --device cpu";
    const std::string compare = "compare spheres --width 64 --height 64 --spp 1 --device cpu";
    return {{render + " -o a.png", "a.png"},
            {render + " -o a.pfm", "a.pfm"},
            {render + " -o a.exr", "a.exr"},
            {render + " -o a.hdr", "a.hdr"},
            {render + " -o a.pfm --partial 1e-4", "a.pfm"},
            {"render spheres -o b.pfm --report r.json" + tiny, "r.json"},
            {"render spheres -o b.pfm --checkpoint r.checkpoint" + tiny, "r.checkpoint"},
            {compare + " --diff d.png", "d.png"},
            {compare + " --report r.json", "r.json"},
            {"diff one.pfm other.pfm --diff d.png", "d.png"},
            {"diff one.pfm other.pfm --report r.json", "r.json"},
            {profile + " -o a.png", "a.png"},
            {profile + " --report r.json", "r.json"},
            {profile + " --csv r.csv", "r.csv"},
            {profile + " --trace r.json", "r.json"},
            {profile + " --html r.html", "r.html"}};
}

constexpr std::size_t limitBytes = 100; // more than a PFM of one pixel, less than any of the files

class EachFile : public OutputFiles {
  protected:
    void SetUp() override {
        OutputFiles::SetUp();
        ASSERT_EQ(run("render spheres -o one.pfm --width 64 --height 64 --spp 1 --device cpu").exitCode, 0);
        ASSERT_EQ(
            run("render spheres -o other.pfm --width 64 --height 64 --spp 1 --seed 2 --device cpu").exitCode,
            0);
    }
};

TEST_F(EachFile, StaysAsItWasOnAFullDisk) {
    Surroundings full;
    full.fileSizeLimitBytes = limitBytes;
    for (const Case &each : allFiles()) {
        store(each.file, "old");
        fs::remove(folder / "b.pfm");
        std::set<std::string> before = entries();
        const Outcome outcome = runIn(full, each.line);
        EXPECT_EQ(outcome.exitCode, 7) << each.line << '\n' << outcome;
        EXPECT_TRUE(contains(outcome.errors, each.file) && contains(outcome.errors, "too large")) << outcome;
        EXPECT_EQ(load(each.file), "old") << each.line;
        std::set<std::string> after = entries();
        after.erase("b.pfm");
        EXPECT_EQ(after, before) << each.line;
        fs::remove(folder / each.file);
    }
}

TEST_F(EachFile, IsRefusedBeforeAnyWorkWhereItsFolderIsMissing) {
    for (const Case &each : allFiles()) {
        std::string line = each.line;
        line.insert(line.rfind(" " + each.file) + 1, "missing/");
        const std::set<std::string> before = entries();
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.exitCode, 7) << line << '\n' << outcome;
        EXPECT_TRUE(contains(outcome.errors, "missing/" + each.file)) << outcome;
        EXPECT_EQ(entries(), before) << line;
    }
}

// The folder goes when the render has begun, as its first checkpoint tells.
TEST_F(OutputFiles, AFolderThatIsDeletedMeanwhileIsReported) {
    fs::create_directory(folder / "gone");
    Surroundings surroundings;
    surroundings.signal = 0; // none
    surroundings.signalWhen = [this] {
        if (!fs::exists(folder / "c"))
            return false;
        fs::remove_all(folder / "gone");
        return true;
    };
    const Outcome outcome =
        runIn(surroundings, "render spheres -o gone/a.png --device cpu --width 96 --height 96 "
                            "--spp 256 --checkpoint c --checkpoint-interval 1e-3");
    EXPECT_EQ(outcome.exitCode, 7) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "gone/a.png")) << outcome;
    EXPECT_FALSE(fs::exists(folder / "gone"));
    // What was rendered is not lost with it.
    const Outcome again =
        run("render spheres -o a.png --device cpu --width 96 --height 96 --spp 256 --checkpoint c "
            "--resume");
    EXPECT_EQ(again.exitCode, 0) << again;
    EXPECT_TRUE(contains(again.errors, "100.0 %")) << again;
}

TEST_F(OutputFiles, AFolderThatIsDeletedMeanwhileDoesNotStopTheCheckpointsOfOthers) {
    fs::create_directory(folder / "gone");
    Surroundings surroundings;
    surroundings.signal = 0; // none
    surroundings.signalWhen = [this] {
        if (!fs::exists(folder / "gone/c"))
            return false;
        fs::remove_all(folder / "gone");
        return true;
    };
    const Outcome outcome =
        runIn(surroundings, "render spheres -o a.pfm --device cpu --width 96 --height 96 --spp 256 "
                            "--checkpoint gone/c --checkpoint-interval 1e-3");
    EXPECT_EQ(outcome.exitCode, 7) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "gone/c")) << outcome;
    EXPECT_EQ(load("a.pfm"), renderPfm("spheres --device cpu --width 96 --height 96 --spp 256"));
}

} // namespace
} // namespace hyalite::testing
