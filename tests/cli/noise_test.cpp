// `render --noise`: what it reaches, says and keeps, and what it cannot be asked for.
#include "tests/cli/command_line.h"
#include "tests/cli/exr_channels.h"

#include <nlohmann/json.hpp>

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace hyalite::core::testing {
namespace {

using Channels = std::map<std::string, std::vector<float>>;

const std::string size = " --width 80 --height 40 --device cpu"; // three blocks and three that are cut

struct Noise : CommandLine {
    [[nodiscard]] Channels channels(const std::string &name) const { return channelsOf(folder / name); }
    [[nodiscard]] nlohmann::json report(const std::string &name) const {
        return nlohmann::json::parse(std::ifstream(folder / name));
    }
    Outcome expectRun(const std::string &line) const {
        Outcome outcome = run(line);
        EXPECT_EQ(outcome.exitCode, 0) << line << outcome;
        return outcome;
    }
    void expectRefusal(const std::string &line, const std::string &text) const {
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.exitCode, 2) << line << outcome;
        EXPECT_TRUE(contains(outcome.errors, text)) << line << outcome;
    }
};

TEST_F(Noise, IsReachedAndTold) {
    const Outcome outcome = expectRun("render cornell -o a.exr --noise 5% --report a.json" + size);
    EXPECT_TRUE(contains(outcome.output, " in the mean, noise ")) << outcome;
    EXPECT_TRUE(contains(outcome.output, " of 5 %")) << outcome;
    const nlohmann::json finished = report("a.json")["finished"];
    EXPECT_TRUE(finished["isComplete"].get<bool>());
    EXPECT_EQ(finished["noise"]["wanted"], 0.05);
    EXPECT_LE(finished["noise"]["highest"].get<double>(), 0.05);
    EXPECT_LE(finished["noise"]["mean"].get<double>(), finished["noise"]["highest"].get<double>());
    EXPECT_EQ(finished["noise"]["blocks"], 6);
    EXPECT_EQ(finished["noise"]["blocksAtTarget"], 6);
    EXPECT_EQ(finished["fewestSamples"], 16);
    EXPECT_GT(finished["mostSamples"].get<int>(), 16);
    const std::vector<float> samples = channels("a.exr").at("samples.Y");
    EXPECT_EQ(std::ranges::max(samples), finished["mostSamples"].get<float>());
    const Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_NE(file.header().findTypedAttribute<Imf::StringAttribute>("noise.highest"), nullptr);
    for (const auto &[name, values] : channels("a.exr")) // what it keeps for itself is no layer
        EXPECT_FALSE(name.starts_with("denoising")) << name;
}

TEST_F(Noise, HasALimit) {
    const Outcome outcome = expectRun("render cornell -o a.exr --noise 1% --spp 24" + size);
    EXPECT_TRUE(contains(outcome.errors, "6 of 6 blocks have more noise than 1 % with --spp 24")) << outcome;
    EXPECT_EQ(std::ranges::max(channels("a.exr").at("samples.Y")), 24.0f);
}

TEST_F(Noise, OfPartsAndOfAResumedRenderIsThatOfTheWhole) {
    expectRun("render cornell -o whole.exr --noise 5% --denoise" + size);
    expectRun("render cornell -o 1.part --part 1/3 --noise 5% --denoise" + size);
    expectRun("render cornell -o 2.part --part 2/3 --noise 40% --denoise" + size);
    expectRun("render cornell -o 2.part --part 2/3 --noise 5% --denoise" + size); // goes on
    expectRun("render cornell -o 3.part --part 3/3 --noise 5% --denoise" + size);
    const Outcome merged = expectRun("merge 1.part 2.part 3.part -o merged.exr --device cpu --audit 100");
    EXPECT_TRUE(contains(merged.output, "0 of 6 tiles")) << merged;
    EXPECT_EQ(channels("merged.exr"), channels("whole.exr"));
    expectRun("render cornell -o resumed.exr --noise 50% --spp 20 --denoise --checkpoint c" + size);
    expectRun("render cornell -o resumed.exr --noise 5% --denoise --checkpoint c --resume" + size);
    EXPECT_EQ(channels("resumed.exr"), channels("whole.exr"));
    expectRun("render cornell -o other.part --part 2/3 --noise 30% --denoise" + size);
    const Outcome other = run("merge 1.part other.part 3.part -o no.exr --device cpu");
    EXPECT_EQ(other.exitCode, 3) << other;
    EXPECT_TRUE(contains(other.errors, "noise: 5 % there, 30 % here")) << other;
}

TEST_F(Noise, OfASceneHasALimitOfItsOwn) {
    std::ofstream(folder / "scene.json") << R"({"spheres": [{"centre": [0, 0, -5], "radius": 1,
        "material": "grey"}], "materials": {"grey": {"type": "diffuse", "albedo": 0.5}}, "background": 1,
        "camera": {"position": [0, 0, 0], "target": [0, 0, -1], "horizontalFov": 40},
        "settings": {"integrator": "path", "noise": 0.1}})";
    expectRun("render scene.json -o a.exr --report a.json" + size);
    const nlohmann::json ofScene = report("a.json");
    EXPECT_EQ(ofScene["settings"]["noise"], 0.1);
    EXPECT_EQ(ofScene["settings"]["spp"], 4096);
    EXPECT_LE(ofScene["finished"]["noise"]["highest"].get<double>(), 0.1);
    expectRun("render scene.json -o a.exr --noise 0% --spp 3 --report a.json" + size);
    EXPECT_TRUE(report("a.json")["finished"]["noise"].is_null());
    EXPECT_EQ(report("a.json")["finished"]["mostSamples"], 3);
}

TEST_F(Noise, HasLayersOfAFixedNumberOfSamples) {
    expectRun("render cornell -o a.exr --noise 30% --layers ao,albedo" + size);
    expectRun("render cornell -o b.exr --spp 64 --layers ao,albedo" + size);
    EXPECT_EQ(channels("a.exr").at("ao.Y"), channels("b.exr").at("ao.Y"));
    EXPECT_EQ(channels("a.exr").at("albedo.R"), channels("b.exr").at("albedo.R"));
}

TEST_F(Noise, IsAShareInPercent) {
    expectRefusal("render cornell -o a.png --noise 2", "found \"2\"; allowed: a percentage");
    expectRefusal("render cornell -o a.png --noise 200%", "allowed:");
    expectRefusal("render cornell -o a.png --noise 2% --integrator ao",
                  "has no effect with the integrator ao");
    expectRefusal("profile cornell --noise 2% --spp 4", "measurement has as many samples in each pixel");
}

} // namespace
} // namespace hyalite::core::testing
