// Every file that any command writes appears whole or not at all: where it cannot be stored, the one that was there
// before stays, the exit code says so, and no other file is left behind.
#include "tests/cli/command_line.h"
#include "tests/cli/fault_process.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

namespace fs = std::filesystem;

using OutputFiles = CommandLine;

struct OutputCase {
    std::string line; ///< a command that writes `file`, and nothing larger than the limit before
    std::string file;
};

const std::string tiny = " --width 1 --height 1 --spp 1 --device cpu";

std::vector<OutputCase> allFiles() {
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
            {compare + " --html r.html", "r.html"},
            {compare + " --junit r.xml", "r.xml"},
            {"diff one.pfm other.pfm --html r.html", "r.html"},
            {"diff one.pfm other.pfm --junit r.xml", "r.xml"},
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
    full.environment = {{"HYALITE_FAKES", "unlimited-memory-files"}, {"HYALITE_VALIDATION", "0"}};
    for (const auto &[name, value] : layerEnvironment)
        full.environment[name] = value;
    for (const OutputCase &each : allFiles()) {
        // A checkpoint replaces nothing else.
        const std::string old = each.file == "r.checkpoint" ? "hyalite checkpoint\n" : "old";
        store(each.file, old);
        fs::remove(folder / "b.pfm");
        std::set<std::string> before = entries();
        const Outcome outcome = runIn(full, each.line);
        EXPECT_EQ(outcome.exitCode, 7) << each.line << '\n' << outcome;
        EXPECT_TRUE(contains(outcome.errors, each.file) && contains(outcome.errors, "too large")) << outcome;
        EXPECT_EQ(load(each.file), old) << each.line;
        std::set<std::string> after = entries();
        after.erase("b.pfm");
        EXPECT_EQ(after, before) << each.line;
        fs::remove(folder / each.file);
    }
}

TEST_F(EachFile, IsRefusedBeforeAnyWorkWhereItsFolderIsMissing) {
    for (const OutputCase &each : allFiles()) {
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
        std::error_code error; // the program may write into it meanwhile
        fs::remove_all(folder / "gone", error);
        return !fs::exists(folder / "gone");
    };
    const Outcome outcome =
        runIn(surroundings, "render spheres -o gone/a.png --device cpu --width 64 --height 64 "
                            "--spp 256 --checkpoint c --checkpoint-interval 1e-3");
    EXPECT_EQ(outcome.exitCode, 7) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "gone/a.png")) << outcome;
    EXPECT_FALSE(fs::exists(folder / "gone"));
    // What was rendered is not lost with it.
    const Outcome again =
        run("render spheres -o a.png --device cpu --width 64 --height 64 --spp 256 --checkpoint c "
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
        std::error_code error; // the program may write into it meanwhile
        fs::remove_all(folder / "gone", error);
        return !fs::exists(folder / "gone");
    };
    const Outcome outcome =
        runIn(surroundings, "render spheres -o a.pfm --device cpu --width 64 --height 64 --spp 256 "
                            "--checkpoint gone/c --checkpoint-interval 1e-3");
    EXPECT_EQ(outcome.exitCode, 7) << outcome;
    EXPECT_TRUE(contains(outcome.errors, "gone/c")) << outcome;
    EXPECT_EQ(load("a.pfm"), renderPfm("spheres --device cpu --width 64 --height 64 --spp 256"));
}

TEST_F(OutputFiles, WhatASceneIsMadeOfIsNotReplaced) {
    const std::string mesh = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    store("a.obj", mesh);
    store("a.mtl", "newmtl m\nKd 1 0 0\n");
    ASSERT_EQ(run("render spheres -o sky.pfm" + tiny).exitCode, 0);
    ASSERT_EQ(run("render spheres -o paint.png" + tiny).exitCode, 0);
    store("s.json", R"({"environment": {"file": "sky.pfm"}, "meshes": [{"file": "a.obj"}],
        "materials": {"m": {"type": "diffuse", "textures": {"baseColour": {"file": "paint.png"}}}},
        "spheres": [{"centre": [0, 0, -5], "radius": 1, "material": "m"}]})");
    const std::vector<std::string> inputs{"s.json", "a.obj", "a.mtl", "sky.pfm", "paint.png"};
    std::vector<std::string> before;
    for (const std::string &input : inputs)
        before.push_back(load(input));
    for (const std::string &input : inputs)
        for (const std::string line :
             {"render s.json -o o.pfm --report ", "render s.json -o o.pfm --checkpoint ",
              "compare s.json --report ", "profile s.json --csv "})
            expectFailure(line + input + (line.starts_with("profile") ? " --width 8 --height 8" : tiny), 2,
                          {input, "this would overwrite"});
    expectFailure("render s.json -o sky.pfm" + tiny, 2, {"this would overwrite"});
    expectFailure("render s.json -o paint.png" + tiny, 2, {"this would overwrite"});
    for (std::size_t i = 0; i < inputs.size(); ++i)
        EXPECT_EQ(load(inputs[i]), before[i]) << inputs[i];
}

TEST_F(OutputFiles, ALinkThatLeadsNowhereYetIsTheFileThatItNames) {
    fs::create_symlink("a.png", folder / "link.png");
    for (const char *line :
         {"render spheres -o a.png --checkpoint link.png", "render spheres -o link.png --report a.png"})
        expectFailure(line + tiny, 2, {"name the same file"});
}

TEST_F(OutputFiles, AReaderOfMessagesThatGoesAwayStopsNoRender) {
    const std::string line = std::string(HYALITE_PROGRAM) + " render spheres -o " +
                             (folder / "a.pfm").string() +
                             " --width 64 --height 64 --spp 64 2>&1 >/dev/null | head -c 1 >/dev/null";
    ASSERT_EQ(std::system(line.c_str()), 0);
    EXPECT_TRUE(fs::exists(folder / "a.pfm"));
}

} // namespace
} // namespace hyalite::core::testing
