// What render's options refuse, before rendering and with a message that helps.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

using RenderRefusals = CommandLine;

const std::string smallRefused = " --width 16 --height 12 --spp 1 --device cpu";

struct OutOfRange {
    const char *option;
    const char *value;
    std::vector<std::string> range;
};

TEST_F(RenderRefusals, ValuesOutOfRangeAreRefusedWithTheRange) {
    const std::vector<OutOfRange> cases{
        {"--width", "0", {"1", "32768"}},
        {"--width", "-5", {"1", "32768"}},
        {"--width", "32769", {"1", "32768"}},
        {"--height", "0", {"1", "32768"}},
        {"--spp", "0", {"1", "65536"}},
        {"--spp", "65537", {"1", "65536"}},
        {"--spp", "99999999999", {"1", "65536"}},
        {"--max-depth", "0", {"1", "32"}},
        {"--max-depth", "33", {"1", "32"}},
        {"--leaf-size", "0", {"1", "64"}},
        {"--leaf-size", "65", {"1", "64"}},
        {"--seed", "-1", {"0", "4294967295"}},
        {"--seed", "4294967296", {"0", "4294967295"}},
        {"--fov", "0", {"0", "180"}},
        {"--fov", "180", {"0", "180"}},
        {"--fov", "nan", {"0", "180"}},
        {"--fov", "inf", {"0", "180"}},
        {"--exposure", "-101", {"-100", "100"}},
        {"--exposure", "1e9", {"-100", "100"}},
        {"--threads", "0", {"1", "1024"}},
        {"--threads", "1025", {"1", "1024"}},
        {"--background", "-1,0,0", {"0"}},
        {"--background", "0,nan,0", {"0"}},
        {"--camera-position", "1e300,0,0", {"1e+15"}},
        {"--up", "0,0,0", {}},
        {"--up", "0,0,1", {}},
        {"--look-at", "0,0,55", {}},
        {"--look-at", "nan,0,0", {}},
    };
    const std::set<std::string> before = entries();
    for (const OutOfRange &wrong : cases) {
        const std::string line = std::string("render spheres -o a.png ") + wrong.option + " " + wrong.value;
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.exitCode, 2) << line << '\n' << outcome;
        EXPECT_EQ(outcome.output, "") << line;
        EXPECT_FALSE(contains(outcome.errors, "device:")) << outcome;
        for (const std::string &bound : wrong.range)
            EXPECT_TRUE(contains(outcome.errors, bound)) << line << ": no bound " << bound << '\n' << outcome;
    }
    EXPECT_EQ(entries(), before);
}

TEST_F(RenderRefusals, RefusalsUseTheNameThatWasTyped) {
    for (const char *wrong : {"--width 0", "--height 0", "--spp 0", "--max-depth 0", "--leaf-size 0",
                              "--fov 0", "--exposure 101", "--threads 0", "--background -1,0,0", "--up 0,0,0",
                              "--look-at 0,0,55", "--camera-position 1e300,0,0"}) {
        const std::string option = std::string(wrong).substr(0, std::string(wrong).find(' '));
        const Outcome outcome = run(std::string("render spheres -o a.png ") + wrong);
        EXPECT_TRUE(contains(outcome.errors, option)) << wrong << '\n' << outcome.errors;
    }
}

TEST_F(RenderRefusals, WhatIsNoNumberIsAUsageError) {
    for (const char *wrong : {"--width abc",
                              "--width 1.5",
                              "--width ''",
                              "--height 3px",
                              "--spp ten",
                              "--max-depth 1e1",
                              "--leaf-size x",
                              "--seed x",
                              "--fov wide",
                              "--fov ''",
                              "--exposure +",
                              "--threads two",
                              "--camera-position a,b,c",
                              "--look-at 1,2",
                              "--look-at 1",
                              "--up 1,2,3,4",
                              "--background 1",
                              "--background red",
                              "--crop 1,2,3",
                              "--crop a,b,c,d",
                              "--crop 0,1.5,0,2"}) {
        const std::string option = std::string(wrong).substr(0, std::string(wrong).find(' '));
        expectFailure(std::string("render spheres -o a.png ") + wrong, 2,
                      // A fourth number may be reported as such.
                      option == "--up" ? std::vector<std::string>{} : std::vector<std::string>{option});
    }
}

TEST_F(RenderRefusals, AnUnknownWordIsAnsweredWithTheWordsThereAre) {
    expectFailure("render spheres -o a.png --sampler fine", 2, {"--sampler", "fine", "centre", "sobol"});
    expectFailure("render spheres -o a.png --bvh fast", 2, {"--bvh", "fast", "midpoint", "sah", "none"});
    // The numbers of an enumeration are nobody's business.
    for (const char *line : {"--sampler fine", "--bvh fast"})
        EXPECT_FALSE(contains(run(std::string("render spheres -o a.png ") + line).errors, "->")) << line;
    for (const char *line : {"--sampler 1", "--bvh 2", "--bvh 0", "--sampler SOBOL", "--sampler ''"})
        expectFailure("render spheres -o a.png " + std::string(line) + smallRefused, 2);
}

TEST_F(RenderRefusals, AnEmptyValueIsAUsageError) {
    for (const char *option : {"--width", "--spp", "--fov", "--seed", "--threads", "--crop", "--up", "--bvh",
                               "--sampler", "--report", "-o"})
        EXPECT_EQ(run(std::string("render spheres ") + option + " ''").exitCode, 2) << option;
    for (const char *option : {"--diff", "--report", "--tolerance", "--max-outliers"})
        expectFailure(std::string("compare spheres ") + option + " ''", 2, {option});
    EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(RenderRefusals, TheWayToWriteAValueIsTold) {
    expectFailure("render spheres -o a.png --max-depth 0", 2,
                  {"--max-depth: found \"0\"; allowed: a whole number from 1 to 32"});
    expectFailure("render spheres -o a.png --look-at 1,2", 2,
                  {"--look-at: found \"1,2\"; allowed: 3 numbers"});
    expectFailure("render spheres -o a.png --look-at 0,0,55", 2, {"--look-at", "the camera's own position"});
    expectFailure("render spheres -o a.png --bvh shah", 2, {"did you mean \"sah\"?"});
}

TEST_F(RenderRefusals, AnOptionWithoutItsValueIsAUsageError) {
    for (const char *option : {"--width", "--spp", "--bvh", "--crop", "--up", "--device", "--report", "-o"})
        EXPECT_EQ(run(std::string("render spheres ") + option).exitCode, 2) << option;
}

} // namespace
} // namespace hyalite::core::testing
