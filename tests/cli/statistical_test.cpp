// `compare --statistical` and `diff --statistical`: renders as estimates of one picture.
#include "tests/cli/command_line.h"

#include <gtest/gtest.h>

#include <string>

namespace hyalite::core::testing {
namespace {

using Statistical = CommandLine;

const std::string smallEstimate = " --width 24 --height 18 --device cpu";

TEST_F(Statistical, RendersOfOneSceneWithTwoSeedsPass) {
    ASSERT_EQ(run("render spheres -o a.exr --spp 16 --seed 1" + smallEstimate).exitCode, 0);
    ASSERT_EQ(run("render spheres -o b.exr --spp 64 --seed 2" + smallEstimate).exitCode, 0);
    const Outcome outcome = run("diff --statistical a.exr b.exr --report r.json");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    for (const char *part : {"tests        1299 ", " 0 untested", "largest      |z| = ", "failing      0",
                             "no difference is significant"})
        EXPECT_TRUE(contains(outcome.output, part)) << outcome;
    const nlohmann::json report = nlohmann::json::parse(load("r.json"));
    EXPECT_EQ(report["passed"], true);
    EXPECT_EQ(report["statistical"]["tests"], 1299);
}

TEST_F(Statistical, ALightThatIsOnePercentStrongerIsCaught) {
    store("a.json", wavySheetScene());
    store("sheet.obj", wavySheetObj(4));
    nlohmann::json brighter = nlohmann::json::parse(wavySheetScene());
    for (nlohmann::json &light : brighter["lights"])
        light["power"] =
            light["power"].is_array() ? light["power"] : nlohmann::json(light["power"].get<double>() * 1.01);
    ASSERT_NE(brighter, nlohmann::json::parse(wavySheetScene()));
    store("b.json", brighter.dump());
    for (const char *name : {"a", "b"})
        ASSERT_EQ(run("render " + std::string(name) + ".json -o " + name + ".exr --spp 64" + smallEstimate)
                      .exitCode,
                  0);
    EXPECT_EQ(run("diff --statistical a.exr a.exr").exitCode, 0);
    const Outcome outcome = run("diff --statistical a.exr b.exr");
    EXPECT_EQ(outcome.exitCode, 1) << outcome;
    EXPECT_TRUE(contains(outcome.output, "NOT estimates of one picture")) << outcome;
}

TEST_F(Statistical, CompareRendersWithTwoSeeds) {
    const Outcome outcome =
        run("compare spheres --statistical --spp 16 --seed 5 --report r.json" + smallEstimate);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_TRUE(contains(outcome.output, "seeds        5 and 6")) << outcome;
    EXPECT_TRUE(contains(outcome.output, "no difference is significant")) << outcome;
    EXPECT_FALSE(contains(outcome.output, "|z| = 0.00")) << outcome;
    EXPECT_EQ(nlohmann::json::parse(load("r.json"))["seeds"], (nlohmann::json{5, 6}));
    EXPECT_TRUE(contains(
        run("compare spheres --statistical --against-seed 9 --spp 16" + smallEstimate).output, "0 and 9"));
}

TEST_F(Statistical, WhatCannotBeTestedIsRefused) {
    ASSERT_EQ(run("render spheres -o a.exr --spp 4" + smallEstimate).exitCode, 0);
    ASSERT_EQ(run("render spheres -o one.exr --spp 1" + smallEstimate).exitCode, 0);
    ASSERT_EQ(run("render spheres -o a.pfm --spp 4" + smallEstimate).exitCode, 0);
    ASSERT_EQ(run("render spheres -o b.exr --spp 4 --width 20 --height 18 --device cpu").exitCode, 0);
    expectFailure("diff --statistical a.exr a.exr", 3, {"no pixel can be tested", "16 samples"});
    expectFailure("diff --statistical a.exr one.exr", 3, {"one.exr", "variance"});
    expectFailure("diff --statistical a.exr a.pfm", 3, {"a.pfm", "EXR"});
    expectFailure("diff --statistical a.exr b.exr", 3, {"24 x 18", "20 x 18"});
    expectFailure("diff --statistical a.exr a.exr --max-flip 1", 2, {"--max-flip"});
    expectFailure("diff a.exr a.exr --significance 0.1", 2, {"--statistical"});
    expectFailure("diff --statistical a.exr a.exr --significance 0", 2, {"--significance"});
    expectFailure("compare spheres --statistical --against-seed 0" + smallEstimate, 2, {"--against-seed 0"});
    expectFailure("compare spheres --statistical --tolerance 1" + smallEstimate, 2, {"--tolerance"});
}

} // namespace
} // namespace hyalite::core::testing
