// Baselines made by hand: a slower kernel is caught, noise is not.
#include "host/base/error.h"
#include "host/report/baseline.h"
#include "host/report/profile_json.h"
#include "tests/fixtures/profile_fixture.h"
#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace hyalite::core {
namespace {

using testing::handMadeProfile;

constexpr double limit = 0.05;
/// A little noise: half the distance between the quartiles is 2 % of the median.
const std::vector<double> calm{0.96, 0.98, 1.0, 1.02, 1.04};

std::vector<double> times(double factor, std::vector<double> scales) {
    for (double &scale : scales)
        scale *= factor;
    return scales;
}

BaselineComparison compare(const Profile &old, const Profile &now, Gate gate = Gate::All) {
    return compareWithBaseline(figuresOf(old), figuresOf(now), limit, gate);
}

TEST(Baseline, OfItselfIsNoRegression) {
    const Profile profile = handMadeProfile(calm);
    const BaselineComparison comparison = compare(profile, profile);
    EXPECT_TRUE(comparison.isPassed);
    ASSERT_EQ(comparison.kernels.size(), 2u);
    EXPECT_DOUBLE_EQ(comparison.kernels[0].ratio, 1.0);
    EXPECT_NEAR(*comparison.kernels[0].noise, 0.02 * std::sqrt(2.0), 1e-6);
    EXPECT_TRUE(comparison.work.empty());
    EXPECT_EQ(comparison.comparedCounts, 6u);
}

TEST(Baseline, ASlowerKernelIsCaught) {
    const BaselineComparison comparison = compare(handMadeProfile(calm), handMadeProfile(times(1.2, calm)));
    EXPECT_FALSE(comparison.isPassed);
    EXPECT_TRUE(comparison.kernels[0].isRegression);
    EXPECT_NEAR(comparison.kernels[0].ratio, 1.2, 1e-6);
    EXPECT_TRUE(comparison.work.empty()) << "the work has not changed";
    const std::string table = comparisonTable(comparison, limit, Gate::All);
    EXPECT_NE(table.find("SLOWER"), std::string::npos) << table;
    EXPECT_NE(table.find("\nREGRESSION (limit 5 %"), std::string::npos) << table;
}

TEST(Baseline, OnlyTheKernelThatIsSlowerIsBlamed) {
    Profile now = handMadeProfile(calm);
    for (Frame &frame : now.frames)
        frame.timeline.dispatches[2].times.device->endNanos += 10'000'000; // of "b", which takes 20 ms
    const BaselineComparison comparison = compare(handMadeProfile(calm), now);
    EXPECT_FALSE(comparison.isPassed);
    EXPECT_FALSE(comparison.kernels[0].isRegression);
    EXPECT_TRUE(comparison.kernels[1].isRegression);
}

TEST(Baseline, NoiseWithinTheSpreadIsNotCaught) {
    // 9 % slower in the median, but either side is off by 15 % now and then.
    const std::vector<double> noisy{0.85, 0.9, 1.0, 1.15, 1.3};
    const BaselineComparison comparison =
        compare(handMadeProfile(noisy), handMadeProfile(times(1.09, noisy)));
    EXPECT_GT(comparison.kernels[0].ratio, 1.05);
    EXPECT_TRUE(comparison.isPassed);
    // The same change between calm runs is one.
    const std::vector<double> still{0.999, 1.0, 1.001};
    EXPECT_FALSE(compare(handMadeProfile(still), handMadeProfile(times(1.09, still))).isPassed);
}

TEST(Baseline, OneWildFrameIsNoRegression) {
    EXPECT_TRUE(compare(handMadeProfile(calm), handMadeProfile({0.98, 1.0, 25.0, 1.01, 0.99})).isPassed);
}

TEST(Baseline, WhatIsFasterOrWithinTheLimitPasses) {
    const std::vector<double> still{1.0, 1.0, 1.0};
    EXPECT_TRUE(compare(handMadeProfile(still), handMadeProfile(times(0.5, still))).isPassed);
    EXPECT_TRUE(compare(handMadeProfile(still), handMadeProfile(times(1.04, still))).isPassed);
}

TEST(Baseline, ASingleFrameHasUnknownNoise) {
    const BaselineComparison comparison = compare(handMadeProfile({1.0}), handMadeProfile({1.0}));
    EXPECT_FALSE(comparison.kernels[0].noise);
    EXPECT_NE(comparisonTable(comparison, limit, Gate::All).find("unknown"), std::string::npos);
}

TEST(Baseline, MoreWorkIsCaughtApartFromTimes) {
    Profile now = handMadeProfile(calm);
    for (Frame &frame : now.frames)
        frame.timeline.dispatches[0].rays.shadow += 1000; // of 6000
    const BaselineComparison comparison = compare(handMadeProfile(calm), now);
    EXPECT_FALSE(comparison.isPassed);
    EXPECT_FALSE(comparison.kernels[0].isRegression);
    ASSERT_EQ(comparison.work.size(), 2u);
    EXPECT_EQ(comparison.work[0].name, "rays.shadow");
    EXPECT_EQ(comparison.work[0].oldCount, 6000u);
    EXPECT_EQ(comparison.work[0].newCount, 7000u);
    EXPECT_TRUE(comparison.work[0].isRegression);
    EXPECT_TRUE(compare(handMadeProfile(calm), now, Gate::Times).isPassed);
    // Less work is told, and is no regression.
    const BaselineComparison back = compare(now, handMadeProfile(calm));
    EXPECT_TRUE(back.isPassed);
    EXPECT_EQ(back.work.size(), 2u);
}

TEST(Baseline, TheGateOfWorkIgnoresTimes) {
    EXPECT_TRUE(compare(handMadeProfile(calm), handMadeProfile(times(3.0, calm)), Gate::Work).isPassed);
}

TEST(Baseline, OfAnotherDeviceItsTimesFailNothing) {
    Profile other = handMadeProfile(times(3.0, calm));
    other.device.name = "another device";
    const BaselineComparison comparison = compare(handMadeProfile(calm), other);
    EXPECT_FALSE(comparison.isSameDevice);
    EXPECT_TRUE(comparison.isPassed);
    EXPECT_NE(comparisonTable(comparison, limit, Gate::All).find("another device"), std::string::npos);
}

TEST(Baseline, KernelsOfOneSideAreNamed) {
    Profile now = handMadeProfile(calm);
    for (Frame &frame : now.frames)
        frame.timeline.dispatches[2].kernel = "c";
    const BaselineComparison comparison = compare(handMadeProfile(calm), now);
    EXPECT_EQ(comparison.kernels.size(), 1u);
    ASSERT_FALSE(comparison.unmatched.empty());
    EXPECT_EQ(comparison.unmatched.front(), "b (only in the baseline)");
}

TEST(Baseline, OfAnotherJobIsRefused) {
    const ProfileFigures baseline = figuresOf(handMadeProfile(calm));
    Profile now = handMadeProfile(calm);
    EXPECT_NO_THROW(requireSameJob(baseline, now));
    now.origin.settings.exposureStops = 2.0;
    EXPECT_NO_THROW(requireSameJob(baseline, now)) << "it costs nothing";
    now.origin.scene = "elsewhere/a.json";
    EXPECT_NO_THROW(requireSameJob(baseline, now)) << "the same scene elsewhere";
    ++now.origin.sceneHash;
    EXPECT_THROW(requireSameJob(baseline, now), Error) << "another scene in a file of that name";
    --now.origin.sceneHash;
    now.origin.settings.samplesPerPixel = 5;
    EXPECT_THROW(requireSameJob(baseline, now), Error);
}

TEST(Baseline, IsReadFromAReport) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "baseline_test.json";
    const auto store = [&](const std::string &text) { std::ofstream(file) << text; };
    const Profile profile = handMadeProfile(calm);
    store(profileToJson(profile).dump());
    const ProfileFigures figures = readFigures(file);
    EXPECT_EQ(figures.job, figuresOf(profile).job);
    EXPECT_EQ(figures.device, "the device, the driver 1.0");
    EXPECT_TRUE(compareWithBaseline(figures, figuresOf(profile), 0.0, Gate::All).isPassed);
    // Whatever is missing or of another kind is told.
    for (const char *key : {"profileVersion", "device", "image", "settings", "scene", "sceneHash", "kernels",
                            "frameMillis", "work"}) {
        for (const nlohmann::json &value : {nlohmann::json(), nlohmann::json("text"), nlohmann::json(-1.5)}) {
            nlohmann::ordered_json damaged = profileToJson(profile);
            if (value.is_null())
                damaged.erase(key);
            else
                damaged[key] = value;
            store(damaged.dump());
            try {
                static_cast<void>(readFigures(file));
                EXPECT_TRUE(std::string(key).starts_with("scene") && value == "text") << key << ": " << value;
            } catch (const Error &error) {
                EXPECT_EQ(error.kind, ErrorKind::BadInput);
                EXPECT_NE(std::string(error.what()).find("baseline_test.json"), std::string::npos);
            }
        }
    }
}

TEST(Baseline, OfAnotherVersionIsRefusedByName) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "baseline.json";
    for (const int version : {1, profileVersion + 1}) {
        nlohmann::ordered_json other = profileToJson(handMadeProfile(calm));
        other["profileVersion"] = version;
        if (version == 1) // which said none
            other.erase("profileVersion");
        std::ofstream(file) << other.dump();
        try {
            static_cast<void>(readFigures(file));
            ADD_FAILURE() << version;
        } catch (const Error &error) {
            EXPECT_NE(std::string(error.what()).find("it has version " + std::to_string(version)),
                      std::string::npos)
                << error.what();
        }
    }
}

TEST(Baseline, NumbersThatDoNotFitAreRefused) {
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "baseline.json";
    for (const char *key : {"/image/width", "/image/height", "/work/rays/primary", "/work/rays/shadow"}) {
        for (const nlohmann::json &value :
             {nlohmann::json(1e300), nlohmann::json(-1e19), nlohmann::json(2.5), nlohmann::json("5")}) {
            nlohmann::json damaged = profileToJson(handMadeProfile(calm));
            damaged.at(nlohmann::json::json_pointer(key)) = value;
            std::ofstream(file) << damaged.dump();
            EXPECT_THROW(static_cast<void>(readFigures(file)), Error) << key << ": " << value;
        }
    }
}

TEST(Baseline, NamesInItAreFitForATerminal) {
    BaselineComparison comparison;
    comparison.unmatched = {"\x1b[31m (only in the baseline)"};
    const std::string table = comparisonTable(comparison, limit, Gate::All);
    EXPECT_NE(table.find("not compared \uFFFD[31m (only in the baseline)"), std::string::npos) << table;
}

TEST(Baseline, ChangesBeyondTheNoiseAreNamed) {
    const Profile old = handMadeProfile(calm);
    const auto changeOf = [&](double factor) {
        return compare(old, handMadeProfile(times(factor, calm))).kernels[0].change();
    };
    EXPECT_EQ(changeOf(1.0), Change::None);
    EXPECT_EQ(changeOf(1.08), Change::None) << "three times 2.8 % are 8.5 %";
    EXPECT_EQ(changeOf(1.09), Change::Slower);
    EXPECT_EQ(changeOf(0.9), Change::Faster);
    EXPECT_EQ(compare(old, handMadeProfile({1.5})).kernels[0].change(), Change::Unknown);
    const BaselineComparison comparison = compare(old, handMadeProfile(times(1.2, calm)));
    ASSERT_EQ(comparison.stages.size(), 4u); // load, upload, dispatches, write
    EXPECT_EQ(comparison.stages[2].name, "dispatches");
    EXPECT_EQ(comparison.stages[2].change(), Change::Slower);
    EXPECT_EQ(comparison.stages[1].change(), Change::None);
}

} // namespace
} // namespace hyalite::core
