// Layers of light by the command line: in files, over parts, resumed, compared, and where they mean nothing.
#include "tests/cli/command_line.h"
#include "tests/cli/exr_channels.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

namespace hyalite::core::testing {
namespace {

using Channels = std::map<std::string, std::vector<float>>;

const std::string lampsSize = " --width 64 --height 48 --spp 4 --quiet";

struct LightFiles : CommandLine {};

/// The layers whose names pass.
template <class Passes> std::set<std::string> layersOf(const Channels &channels, const Passes &passes) {
    std::set<std::string> layers;
    for (const auto &[name, values] : channels)
        if (const std::size_t dot = name.find('.'); dot != std::string::npos && passes(name.substr(0, dot)))
            layers.insert(name.substr(0, dot));
    return layers;
}

/// How far the sum of the layers is from the picture, as a share of it.
double largestError(const Channels &channels, const std::set<std::string> &layers) {
    double largest = 0.0;
    for (const char *channel : {"R", "G", "B"})
        for (std::size_t i = 0; i < channels.at("R").size(); ++i) {
            double sum = 0.0;
            for (const std::string &layer : layers)
                sum += static_cast<double>(channels.at(layer + "." + channel)[i]);
            const auto wanted = static_cast<double>(channels.at(channel)[i]);
            largest = std::max(largest, std::abs(sum - wanted) / std::max(wanted, 1e-6));
        }
    return largest;
}

TEST_F(LightFiles, AddUpToThePicture) {
    ASSERT_EQ(run("render lamps -o a.exr --light-layers --light-groups" + lampsSize).exitCode, 0);
    const Channels channels = channelsOf(folder / "a.exr");
    const auto isGroup = [](const std::string &name) { return name.starts_with("light_"); };
    const std::set<std::string> groups = layersOf(channels, isGroup);
    EXPECT_EQ(groups, (std::set<std::string>{"light_warm", "light_cool", "light_default"}));
    const std::set<std::string> classes = layersOf(channels, [&](const std::string &name) {
        return !isGroup(name) && name != "variance" && name != "samples";
    });
    EXPECT_EQ(classes, (std::set<std::string>{"emission", "background", "diffuse_direct", "diffuse_indirect",
                                              "glossy_direct", "glossy_indirect", "transmission_direct",
                                              "transmission_indirect"}));
    EXPECT_LT(largestError(channels, groups), 1e-6);
    EXPECT_LT(largestError(channels, classes), 1e-6);
    ASSERT_EQ(run("render lamps -o plain.exr" + lampsSize).exitCode, 0);
    EXPECT_EQ(channelsOf(folder / "plain.exr").at("R"), channels.at("R"));
}

TEST_F(LightFiles, OfPartsAndOfAResumedRenderAreThoseOfOne) {
    const std::string line = "render lamps --light-layers --light-groups" + lampsSize;
    ASSERT_EQ(run(line + " -o whole.exr --device cpu").exitCode, 0);
    for (const std::string part : {"1", "2", "3"})
        ASSERT_EQ(run(line + " -o " + part + ".part --part " + part + "/3").exitCode, 0);
    ASSERT_EQ(run("merge 1.part 2.part 3.part -o merged.exr --quiet").exitCode, 0);
    EXPECT_TRUE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "merged.exr")));
    ASSERT_EQ(run("render lamps --light-layers --light-groups --width 64 --height 48 --spp 2 --quiet "
                  "-o less.exr --checkpoint c")
                  .exitCode,
              0);
    ASSERT_EQ(run(line + " -o more.exr --checkpoint c --resume").exitCode, 0);
    EXPECT_TRUE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "more.exr")));
    ASSERT_EQ(run(line + " -o shared.exr --device all").exitCode, 0);
    EXPECT_TRUE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "shared.exr")));
}

TEST_F(LightFiles, AreComparedBetweenDevices) {
    const Outcome outcome = run("compare lamps --against cpu --light-layers" + lampsSize);
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_NE(outcome.output.find("light        0 of 3072 differ"), std::string::npos) << outcome;
    EXPECT_NE(outcome.output.find("equal, bit for bit"), std::string::npos) << outcome;
}

TEST_F(LightFiles, WhereTheyMeanNothingOrAreLostAreTold) {
    const Outcome view = run("render lamps -o a.exr --light-layers --integrator normal" + lampsSize);
    EXPECT_EQ(view.exitCode, 2) << view;
    EXPECT_NE(view.errors.find("--light-layers: has no effect with the integrator normal"), std::string::npos)
        << view;
    const Outcome flat = run("render lamps -o a.png --light-groups --width 8 --height 8 --spp 1");
    EXPECT_EQ(flat.exitCode, 0) << flat;
    EXPECT_NE(flat.errors.find("none of the layers of light"), std::string::npos) << flat;
    store("odd.json", R"({"lights": [{"type": "point", "position": [0, 1, 0], "power": 1,
                                      "lightGroup": "key light"}]})");
    const Outcome odd = run("render odd.json -o a.exr --quiet");
    EXPECT_EQ(odd.exitCode, 3) << odd;
    EXPECT_NE(odd.errors.find("letters, digits, underscores and hyphens"), std::string::npos) << odd;
}

} // namespace
} // namespace hyalite::core::testing
