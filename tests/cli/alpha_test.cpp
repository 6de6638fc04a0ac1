// Alpha and shadow catchers by the command line: in files, over parts, resumed, and where they mean nothing.
#include "host/image/image_file.h"
#include "tests/cli/command_line.h"
#include "tests/cli/exr_channels.h"

#include <algorithm>
#include <filesystem>

namespace hyalite::core::testing {
namespace {

struct AlphaFiles : CommandLine {
    void SetUp() override {
        CommandLine::SetUp();
        std::filesystem::copy(HYALITE_SOURCE_DIR "/tests/bits/catcher.json", folder / "catcher.json");
    }
};

// A shadow is in alpha alone; a ball is opaque; beside both nothing is.
TEST_F(AlphaFiles, HaveShadowsAndTheOpacityOfThings) {
    ASSERT_EQ(run("render catcher.json -o a.exr --quiet --layers shadow,object-id").exitCode, 0);
    const auto channels = channelsOf(folder / "a.exr");
    const std::vector<float> &alpha = channels.at("A");
    const std::vector<float> &shadow = channels.at("shadow.Y");
    std::size_t shadows = 0;
    std::size_t balls = 0;
    std::size_t nothing = 0;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        const float brightness = channels.at("R")[i] + channels.at("G")[i] + channels.at("B")[i];
        EXPECT_GE(alpha[i], shadow[i]);
        shadows += shadow[i] > 0.0f && shadow[i] == alpha[i] && brightness == 0.0f ? 1u : 0u;
        balls += shadow[i] == 0.0f && alpha[i] == 1.0f && brightness > 0.0f ? 1u : 0u;
        nothing += alpha[i] == 0.0f && brightness == 0.0f ? 1u : 0u;
    }
    EXPECT_GT(shadows, 300u);
    EXPECT_GT(balls, 500u);
    EXPECT_GT(nothing, 2000u);
}

TEST_F(AlphaFiles, OfAPngAreStraightAndKeepShadows) {
    ASSERT_EQ(run("render catcher.json -o a.exr --quiet").exitCode, 0);
    const Outcome outcome = run("render catcher.json -o a.png");
    ASSERT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_EQ(outcome.errors.find("layers"), std::string::npos)
        << outcome; // the shadows are no layer of the user's
    ASSERT_EQ(run("tonemap a.exr b.png").exitCode, 0);
    const LoadedImage rendered = readImage(folder / "a.png");
    const LoadedImage mapped = readImage(folder / "b.png");
    EXPECT_EQ(rendered.image.pixels(), mapped.image.pixels());
    EXPECT_EQ(rendered.alpha, mapped.alpha);
    EXPECT_GT(std::ranges::count_if(rendered.alpha, [](float a) { return a > 0.0f && a < 1.0f; }), 300);
}

TEST_F(AlphaFiles, OfPartsAndOfAResumedRenderAreThoseOfOne) {
    ASSERT_EQ(run("render catcher.json -o whole.exr --quiet --device cpu").exitCode, 0);
    for (const std::string part : {"1", "2", "3"})
        ASSERT_EQ(run("render catcher.json -o " + part + ".part --quiet --part " + part + "/3").exitCode, 0);
    ASSERT_EQ(run("merge 1.part 2.part 3.part -o merged.exr --quiet").exitCode, 0);
    EXPECT_TRUE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "merged.exr")));
    ASSERT_EQ(run("merge 1.part 2.part 3.part -o merged.png --quiet").exitCode, 0);
    EXPECT_FALSE(readImage(folder / "merged.png").alpha.empty());

    ASSERT_EQ(run("render catcher.json -o less.exr --quiet --spp 2 --checkpoint c").exitCode, 0);
    ASSERT_EQ(run("render catcher.json -o more.exr --quiet --checkpoint c --resume").exitCode, 0);
    EXPECT_TRUE(areSame(channelsOf(folder / "whole.exr"), channelsOf(folder / "more.exr")));
    const Outcome other =
        run("render catcher.json -o other.exr --quiet --checkpoint c --resume --alpha=false");
    EXPECT_EQ(other.exitCode, 3) << other;
    EXPECT_NE(other.errors.find("alpha: true there, false here"), std::string::npos) << other;
}

// Whoever turns alpha off has an ordinary picture, with a matt floor.
TEST_F(AlphaFiles, AreNotThereWithout) {
    ASSERT_EQ(run("render catcher.json -o a.exr --quiet --alpha=false").exitCode, 0);
    const auto channels = channelsOf(folder / "a.exr");
    EXPECT_FALSE(channels.contains("A"));
    EXPECT_FALSE(channels.contains("shadow.Y"));
    EXPECT_GT(std::ranges::count_if(channels.at("R"), [](float red) { return red > 0.0f; }), 5500);
}

TEST_F(AlphaFiles, ThatMeanNothingAreRefused) {
    const Outcome view = run("render catcher.json -o a.exr --alpha --integrator normal");
    EXPECT_EQ(view.exitCode, 2) << view;
    EXPECT_NE(view.errors.find("--alpha: has no effect with the integrator normal"), std::string::npos)
        << view;
    const Outcome glass = run("render spheres -o a.exr --alpha-through-glass");
    EXPECT_EQ(glass.exitCode, 2) << glass;
    EXPECT_NE(glass.errors.find("alphaThroughGlass: found true without alpha; allowed: with alpha"),
              std::string::npos)
        << glass;
}

TEST_F(AlphaFiles, AreComparedBetweenDevices) {
    const Outcome outcome = run("compare catcher.json --against cpu --alpha-through-glass");
    EXPECT_EQ(outcome.exitCode, 0) << outcome;
    EXPECT_NE(outcome.output.find("equal, bit for bit"), std::string::npos) << outcome;
}

} // namespace
} // namespace hyalite::core::testing
