#include "host/base/error.h"
#include "host/cli/commands.h"
#include "host/image/image_file.h"
#include "tests/fixtures/synthetic_picture.h"
#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

namespace fs = std::filesystem;

class DiffTest : public ::testing::Test {
  protected:
    void SetUp() override {
        a = linearPicture(32, 24, 0);
        b = a;
        b.at(4, 5).x += 0.5f;
        b.at(20, 7).y += 0.25f;
        store("a.pfm", a);
        store("a2.pfm", a);
        store("b.pfm", b);
        store("a.png", a);
        store("b.png", b);
    }
    void store(const std::string &name, const Image &image) const {
        AtomicFile file(folder / name);
        writeImage(file, imageFormatOf(name), image, 0.0);
        file.commit();
    }

    /// The exit code; file names are in the test's folder.
    int diff(std::vector<std::string> arguments) const {
        CLI::App app;
        CommandContext context;
        addDiffCommand(app, context);
        for (std::string &argument : arguments) {
            const bool isFile =
                argument.ends_with(".pfm") || argument.ends_with(".png") || argument.ends_with(".json");
            argument = isFile ? (folder / argument).string() : argument;
        }
        arguments.insert(arguments.begin(), "diff");
        std::reverse(arguments.begin(), arguments.end()); // as CLI::App::parse wants them
        ::testing::internal::CaptureStdout();
        try {
            app.parse(arguments);
        } catch (const Error &error) {
            context.exitCode = exitCodeOf(error.kind);
        } catch (const CLI::ParseError &) {
            context.exitCode = ExitCode::Usage;
        }
        output = ::testing::internal::GetCapturedStdout();
        return static_cast<int>(context.exitCode);
    }

    const testing::TemporaryFolder temporary_;
    const fs::path &folder = temporary_.path;
    Image a;
    Image b;
    mutable std::string output;
};

TEST_F(DiffTest, WithoutAGateOnlyIdenticalImagesPass) {
    EXPECT_EQ(diff({"a.pfm", "a2.pfm"}), 0);
    EXPECT_NE(output.find("\nidentical\n"), std::string::npos) << output;
    EXPECT_EQ(diff({"a.pfm", "b.pfm"}), 1);
    EXPECT_NE(output.find("2 (0.2604 %) pixels"), std::string::npos) << output;
    EXPECT_NE(output.find("0.5 at (4, 5)"), std::string::npos) << output;
    EXPECT_EQ(diff({"a.png", "a.png"}), 0);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--threshold", "10"}), 1); // a threshold is no gate
}

TEST_F(DiffTest, EveryGateDecidesOnItsSideOfTheLimit) {
    // Squared error: (0.25 + 0.0625) / (3 * 32 * 24), 38.67 dB.
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--min-psnr", "38.6"}), 0);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--min-psnr", "38.8"}), 1);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-diff", "0.5"}), 0);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-diff", "0.49"}), 1);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-outliers", "0.003"}), 0);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-outliers", "0.002"}), 1);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-outliers", "0.002", "--threshold", "0.3"}), 0);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-flip", "0.2"}), 0);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-flip", "0"}), 1);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--min-ssim", "0.5"}), 0);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--min-ssim", "1"}), 1);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--min-ssim", "0.5", "--max-diff", "0.1"}), 1); // all must pass
    EXPECT_EQ(diff({"a.pfm", "a2.pfm", "--min-psnr", "1000"}), 0);
}

TEST_F(DiffTest, TheMaskSelectsPixels) {
    Image mask = constantPicture(32, 24, glm::vec3(1.0f));
    mask.at(4, 5) = glm::vec3(0.0f);
    store("mask.png", mask);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--mask", "mask.png", "--max-diff", "0.25"}), 0);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--mask", "mask.png"}), 1);
    mask.at(20, 7) = glm::vec3(0.0f);
    store("mask.png", mask);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--mask", "mask.png"}), 0);
    store("mask.png", constantPicture(32, 24, glm::vec3(0.0f)));
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--mask", "mask.png"}), 3);
    store("mask.png", constantPicture(32, 25, glm::vec3(1.0f)));
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--mask", "mask.png"}), 3);
}

TEST_F(DiffTest, WritesTheHeatMapAndTheReport) {
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--diff", "map.png", "--report", "r.json", "--max-diff", "0.25"}), 1);
    const Image map = readImage(folder / "map.png").image;
    EXPECT_EQ(map.width(), 32);
    EXPECT_EQ(map.at(0, 23), glm::vec3(0.0f, 0.0f, 4.0f) / 255.0f); // far from both
    EXPECT_NE(map.at(4, 5), map.at(0, 23));
    const auto report = nlohmann::json::parse(std::ifstream(folder / "r.json"));
    EXPECT_FALSE(report["passed"].get<bool>());
    EXPECT_EQ(report["differingPixelCount"], 2);
    EXPECT_EQ(report["gates"][0]["option"], "--max-diff");
    EXPECT_EQ(report["gates"][0]["value"], 0.5);
    EXPECT_FALSE(report["gates"][0]["passed"].get<bool>());
}

TEST_F(DiffTest, ALinearImageIsToneMappedToMeetADisplayedOne) {
    EXPECT_EQ(diff({"a.pfm", "a.png"}), 0);
    EXPECT_NE(output.find("tone-mapped"), std::string::npos) << output;
    EXPECT_EQ(diff({"b.png", "b.pfm"}), 0);
}

TEST_F(DiffTest, WhatCannotBeComparedIsBadInput) {
    store("wide.pfm", constantPicture(33, 24, glm::vec3(1.0f)));
    store("tiny.pfm", constantPicture(5, 5, glm::vec3(1.0f)));
    EXPECT_EQ(diff({"a.pfm", "wide.pfm"}), 3);
    EXPECT_EQ(diff({"a.pfm", "missing.pfm"}), 3);
    EXPECT_EQ(diff({"tiny.pfm", "tiny.pfm"}), 0);
    EXPECT_EQ(diff({"tiny.pfm", "tiny.pfm", "--min-ssim", "0.5"}), 3); // there is none
}

TEST_F(DiffTest, OutputsAreCheckedBeforeTheWork) {
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--diff", "map.pfm"}), 2);
    EXPECT_EQ(diff({"a.png", "b.png", "--diff", "a.png"}), 2);
    EXPECT_EQ(diff({"a.png", "b.png", "--report", "b.png"}), 2);
    EXPECT_EQ(diff({"a.png", "b.png", "--report", "x.png", "--diff", "x.png"}), 2);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--report", "no/such/folder/r.json"}), 7);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-diff", "nan"}), 2);
    EXPECT_EQ(diff({"a.pfm", "b.pfm", "--max-outliers", "1.5"}), 2);
    EXPECT_EQ(diff({"a.pfm"}), 2);
}

} // namespace
} // namespace hyalite::core
