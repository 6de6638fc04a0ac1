// --help, --version, and command lines that are wrong.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

using Usage = CommandLine;

const std::vector<std::string> sceneOptions{"--width", "--height",          "--spp",     "--max-depth",
                                            "--bvh",   "--leaf-size",       "--sampler", "--seed",
                                            "--crop",  "--camera-position", "--look-at", "--up",
                                            "--fov",   "--background",      "--exposure"};

TEST_F(Usage, HelpMentionsEveryOption) {
    std::map<std::string, std::vector<std::string>> optionsOf{
        {"render", sceneOptions}, {"inspect", {"--rays"}}, {"devices", {"--json"}}};
    for (const char *option :
         {"-o", "--output", "--device", "--threads", "--kernel", "--report", "--time-limit", "--quiet"})
        optionsOf["render"].emplace_back(option);
    for (const char *option : {"--bvh", "--leaf-size"})
        optionsOf["inspect"].emplace_back(option);
    for (const auto &[command, options] : optionsOf) {
        const Outcome outcome = run(command + " --help");
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_EQ(outcome.errors, "");
        for (const std::string &option : options)
            EXPECT_TRUE(contains(outcome.output, option)) << command << ": " << option;
        EXPECT_EQ(run(command + " -h").output, outcome.output);
    }
    for (const char *word : {"auto", "cpu", "midpoint", "sah", "none", "centre", "sobol", ".png", ".pfm"})
        EXPECT_TRUE(contains(run("render --help").output, word)) << word;
}

TEST_F(Usage, HelpListsTheCommandsAndTheExitCodes) {
    const Outcome outcome = run("--help");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.errors, "");
    for (const char *part : {"render", "devices", "inspect", "--version", "Exit codes"})
        EXPECT_TRUE(contains(outcome.output, part)) << part;
}

TEST_F(Usage, HelpFitsATerminalAndShowsNoInnards) {
    for (const char *command : {"", "render ", "compare ", "diff ", "devices ", "doctor ", "inspect "}) {
        const std::string page = run(command + std::string("--help")).output;
        EXPECT_FALSE(contains(page, "\n\n\n")) << page;
        std::istringstream lines(page);
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 100u) << line;
            EXPECT_FALSE(contains(line, "->")) << line;
        }
    }
    EXPECT_TRUE(contains(run("render --help").output, "Usage: hyalite render [OPTIONS] SCENE\n"));
}

TEST_F(Usage, VersionIsOneLine) {
    const Outcome outcome = run("--version");
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_TRUE(std::regex_match(outcome.output, std::regex("hyalite [0-9]+\\.[0-9]+\\.[0-9]+\n")))
        << outcome;
    EXPECT_EQ(outcome.errors, "");
    for (const char *command : {"render", "compare", "denoise", "diff", "tonemap", "devices", "inspect"})
        EXPECT_EQ(run(std::string(command) + " --version").output, outcome.output);
}

TEST_F(Usage, NothingAtAllIsAnsweredWithTheCommands) {
    expectFailure("", 2, {"render", "devices", "inspect"});
}

TEST_F(Usage, AnUnknownCommandIsNamed) {
    expectFailure("rendre spheres -o a.png", 2, {"\"rendre\"", "compare", "did you mean \"render\"?"});
    expectFailure("foo", 2, {"\"foo\"", "render", "compare", "devices", "inspect", "diff"});
}

TEST_F(Usage, AnUnknownOptionIsNamed) {
    expectFailure("render spheres -o a.png --hieght 3", 2, {"\"--hieght\"", "did you mean \"--height\"?"});
    expectFailure("render spheres -o a.png -x", 2, {"-x"});
    expectFailure("--hieght 3", 2);
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(Usage, WhatIsMissingIsNamed) {
    expectFailure("render", 2);
    expectFailure("render -o a.png", 2, {"scene"});
    expectFailure("render spheres", 2, {"--output"});
    expectFailure("render spheres cat -o a.png", 2, {"cat"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(Usage, AnOptionGivenTwiceIsNoAccident) {
    expectFailure("render spheres -o a.png --spp 1 --spp 2", 2, {"hyalite: --spp is given twice"});
    expectFailure("render spheres -o a.png --width 3 --height 4 --width=3", 2, {"--width is given twice"});
    expectFailure("render spheres -o a.png -o b.png", 2, {"--output is given twice"});
    expectFailure("render spheres -o a.png --seed 1 --seed 2 --seed 3", 2,
                  {"--seed is given more than once"});
    expectFailure("render spheres -o a.png --up 0,1,0 --up 0,0,1", 2, {"--up is given twice"});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(Usage, AnOptionWithoutEffectIsNamed) {
    expectFailure("render spheres -o a.png --clamp 2", 2,
                  {"--clamp: has no effect with the integrator whitted", "path"});
    expectFailure("render spheres -o a.png --ao-distance 2 --integrator path", 2,
                  {"--ao-distance: has no effect with the integrator path", "allowed: with ao"});
    expectFailure("compare spheres --max-depth 2 --integrator normal", 2,
                  {"--max-depth", "integrator normal"});
    expectFailure("render spheres -o a.exr --tone agx", 2, {"--tone is for .png files", "a.exr", "tonemap"});
    expectFailure("profile spheres --gate times", 2, {"--gate needs --baseline FILE.json"});
    expectFailure("profile spheres --max-regression 7%", 2, {"--max-regression needs --baseline FILE.json"});
    EXPECT_EQ(entries(), std::set<std::string>{});
    const std::string small = " --width 4 --height 4 --spp 1 --device cpu --quiet";
    EXPECT_EQ(run("render spheres -o a.pfm --clamp 2 --integrator path" + small).exitCode, 0);
}

TEST_F(Usage, HelpIsACommandToo) {
    EXPECT_EQ(run("help").output, run("--help").output);
    for (const char *command : {"render", "inspect"}) {
        const Outcome outcome = run(std::string("help ") + command);
        EXPECT_EQ(outcome.exitCode, 0) << outcome;
        EXPECT_EQ(outcome.output, run(std::string(command) + " --help").output);
    }
    expectFailure("help rendre", 2, {"there is no command \"rendre\"", "did you mean \"render\"?"});
}

TEST_F(Usage, ErrorsSayWhoSpeaks) {
    for (const char *line : {"", "render", "render spheres", "render spheres -o a.png --spp x",
                             "render spheres -o a.png --spp 0", "render x -o a.png"})
        EXPECT_EQ(run(line).errors.substr(0, 9), "hyalite: ") << line;
}

} // namespace
} // namespace hyalite::core::testing
