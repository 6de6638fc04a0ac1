// Scenes that are small and far from zero, as those of geodesy, on the command line.
#include "tests/cli/command_line.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

namespace hyalite::core::testing {
namespace {

using Place = std::array<double, 3>;

constexpr Place zero{0.0, 0.0, 0.0};
constexpr Place utm{500'000.0, 100.0, 5'400'000.0};

/// A rugged square of 10 by 10, whose coordinates are eighths.
std::string groundAt(const Place &place) {
    std::string text;
    constexpr int side = 17;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            text += fmt::format("v {} {} {}\n", place[0] + 0.625 * x - 5.0,
                                place[1] + 0.125 * ((7 * x + 5 * y) % 9), place[2] + 0.625 * y - 5.0);
    for (int y = 0; y + 1 < side; ++y)
        for (int x = 0; x + 1 < side; ++x) {
            const int first = side * y + x + 1;
            text += fmt::format("f {} {} {} {}\n", first, first + side, first + side + 1, first + 1);
        }
    return text;
}

std::string pointAt(const Place &place, const Place &offset) {
    return fmt::format("{},{},{}", place[0] + offset[0], place[1] + offset[1], place[2] + offset[2]);
}

class FarCommand : public CommandLine {
  protected:
    void SetUp() override {
        CommandLine::SetUp();
        store("near.obj", groundAt(zero));
        store("far.obj", groundAt(utm));
    }
};

TEST_F(FarCommand, ThePictureIsThatOfTheNearScene) {
    const std::string small = " --width 48 --height 36 --spp 2 --device ";
    for (const std::string &device : {std::string("cpu"), softwareDevice()})
        EXPECT_EQ(renderPfm("far.obj" + small + device), renderPfm("near.obj" + small + device)) << device;
    const auto viewAt = [&](const Place &place) {
        return fmt::format(" --camera-position {} --look-at {}{}cpu", pointAt(place, {4, 6, 9}),
                           pointAt(place, {0.5, 0, -1}), small);
    };
    for (const char *integrator : {"whitted", "path", "depth", "id"})
        EXPECT_EQ(renderPfm(fmt::format("far.obj --integrator {}{}", integrator, viewAt(utm))),
                  renderPfm(fmt::format("near.obj --integrator {}{}", integrator, viewAt(zero))))
            << integrator;
}

TEST_F(FarCommand, ReportsAndInspectSpeakInTheFilesCoordinates) {
    const std::string small = " --device cpu --width 8 --height 8 --spp 1";
    EXPECT_EQ(renderReport("far.obj" + small).at("origin"), (nlohmann::json{500'000.0, 100.0, 5'400'000.0}));
    EXPECT_FALSE(renderReport("near.obj" + small).contains("origin"));
    const Outcome outcome = run("inspect far.obj --camera-position " + pointAt(utm, {4, 6, 9}));
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    for (const char *part : {"bounds       (499995, 100, 5399995) to (500005, 101, 5400005)",
                             "origin       (500000, 100, 5400000)", "at (500004, 106, 5400009), looks along"})
        EXPECT_TRUE(contains(outcome.output, part)) << part << '\n' << outcome;
    EXPECT_FALSE(contains(run("inspect near.obj").output, "origin "));
}

TEST_F(FarCommand, PartsAndTurntablesAreThoseOfTheNearScene) {
    const std::string small = " --device cpu --width 32 --height 32 --spp 1 --quiet";
    for (const std::string &name : {std::string("near"), std::string("far")}) {
        for (const std::string &part : {std::string("1"), std::string("2")})
            ASSERT_EQ(run("render " + name + ".obj --part " + part + "/2 -o " + name + part + ".part" + small)
                          .exitCode,
                      0);
        ASSERT_EQ(run("render " + name + ".obj --turntable 3 -o " + name + ".#.pfm" + small).exitCode, 0);
    }
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_EQ(load(fmt::format("near.{}.pfm", frame)), load(fmt::format("far.{}.pfm", frame))) << frame;
    ASSERT_EQ(run("merge near1.part near2.part -o near.pfm").exitCode, 0);
    ASSERT_EQ(run("merge far1.part far2.part -o far.pfm --audit 100%").exitCode, 0);
    EXPECT_EQ(load("near.pfm"), load("far.pfm"));
}

} // namespace
} // namespace hyalite::core::testing
