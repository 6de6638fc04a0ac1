// What a profile made by hand comes to, as figures, as a table, as CSV and as JSON.
#include "host/report/profile_csv.h"
#include "host/report/profile_json.h"
#include "host/report/profile_table.h"
#include "tests/fixtures/profile_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace hyalite::core {
namespace {

using testing::handMadeProfile;

std::vector<std::string> linesOf(const std::string &text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

TEST(Profile, KernelsAreSummedByName) {
    const std::vector<KernelSummary> kernels = summariseKernels(handMadeProfile({1.0, 1.5, 2.0}));
    ASSERT_EQ(kernels.size(), 2u);
    const KernelSummary &a = kernels[0];
    EXPECT_EQ(a.times.name, "a");
    EXPECT_EQ(a.times.launchCount, 2u);
    EXPECT_EQ(a.times.frameMillis, (std::vector<double>{40.0, 60.0, 80.0}));
    EXPECT_DOUBLE_EQ(a.times.medianFrameMillis(), 60.0);
    EXPECT_EQ(a.times.launch.count, 6u);
    EXPECT_DOUBLE_EQ(a.times.launch.min, 10.0);
    EXPECT_DOUBLE_EQ(a.times.launch.median, 25.0);
    EXPECT_DOUBLE_EQ(a.times.launch.max, 60.0);
    EXPECT_DOUBLE_EQ(*a.times.firstMillis, 120.0);
    EXPECT_EQ(a.invocations, 384u);
    EXPECT_EQ(a.rays, (RayCounts{2000, 4000, 600, 80}));
    // Of 40, 60, 80 ms in frames of 70, 100 and 130 ms.
    EXPECT_DOUBLE_EQ(a.times.share, 180.0 / 300.0);
    EXPECT_DOUBLE_EQ(a.megaraysPerSecond(a.rays.shadow), 4000.0 / 1e6 / 0.060);
    EXPECT_EQ(kernels[1].times.launchCount, 1u);
    EXPECT_EQ(kernels[1].times.frameMillis, (std::vector<double>{20.0, 30.0, 40.0}));
}

TEST(Profile, AHostClockTimesWhatHasNoTimestamps) {
    Profile profile = handMadeProfile({1.0});
    for (Frame &frame : profile.frames)
        for (DispatchRecord &dispatch : frame.timeline.dispatches)
            dispatch.times.device.reset();
    EXPECT_EQ(summariseKernels(profile)[0].times.frameMillis, std::vector<double>{42.0});
}

TEST(Profile, StagesKeepTheirOrderAndFillTheFrame) {
    const Profile profile = handMadeProfile({1.0, 1.0, 1.0});
    const std::vector<StageSummary> stages = summariseStages(profile);
    ASSERT_EQ(stages.size(), 4u);
    EXPECT_EQ(stages[0].name, "load");
    EXPECT_EQ(stages[1].name, "upload");
    EXPECT_EQ(stages[2].name, "dispatches");
    EXPECT_EQ(stages[3].name, "write");
    EXPECT_FALSE(stages[0].isInFrame);
    EXPECT_DOUBLE_EQ(stages[0].medianFrameMillis(), 2.0);
    EXPECT_FALSE(stages[0].firstMillis);
    EXPECT_DOUBLE_EQ(stages[1].medianFrameMillis(), 5.0);
    EXPECT_DOUBLE_EQ(stages[2].medianFrameMillis(), 63.0);
    EXPECT_DOUBLE_EQ(stageShare(stages), 68.0 / 70.0);
    EXPECT_EQ(maxDeviceBytes(profile), 2500u);
}

TEST(Profile, AStageThatIsRepeatedInAFrameIsAddedUp) {
    Profile profile = handMadeProfile({1.0});
    std::vector<StageRecord> &stages = profile.frames.back().timeline.stages;
    stages.push_back({"upload", testing::millisSpan(5000.0, 5007.0)});
    const StageSummary upload = summariseStages(profile)[1];
    EXPECT_EQ(upload.launchCount, 2u);
    EXPECT_EQ(upload.frameMillis, std::vector<double>{12.0});
    EXPECT_DOUBLE_EQ(upload.launch.min, 5.0);
}

TEST(Profile, WithoutAFrameBeforeThereIsNoFirstTime) {
    Profile profile = handMadeProfile({1.0, 2.0});
    profile.frames.erase(profile.frames.begin());
    EXPECT_FALSE(summariseKernels(profile)[0].times.firstMillis);
    EXPECT_EQ(summariseKernels(profile)[0].times.frameMillis.size(), 2u);
}

TEST(ProfileTable, FitsAndHasARowForEachStageAndKernel) {
    const std::string table = profileTable(handMadeProfile({1.0, 1.5, 2.0}));
    for (const std::string &line : linesOf(table))
        EXPECT_LE(line.size(), 110u) << line;
    for (const char *name : {"\nload ", "\nupload ", "\ndispatches ", "\nwrite ", "\nframe ", "\na ", "\nb "})
        EXPECT_NE(table.find(name), std::string::npos) << name << table;
    EXPECT_NE(table.find("60.0 %"), std::string::npos) << table;
}

TEST(ProfileCsv, HasALineForEachDispatch) {
    Profile profile = handMadeProfile({1.0});
    profile.frames[1].timeline.dispatches[0].kernel = "odd, \"name\"";
    profile.frames[1].timeline.dispatches[2].times.device.reset();
    const std::vector<std::string> lines = linesOf(profileCsv(profile));
    ASSERT_EQ(lines.size(), 1u + 2u * 3u);
    const auto columnCount = [](const std::string &line) {
        return std::count(line.begin(), line.end(), ',');
    };
    EXPECT_EQ(
        lines[1],
        "warm-up 1,0,0,a,0,8,16,12,0,4,0,192,1000,2000,300,40,0,5.000000,31.000000,5.500000,30.000000\r");
    EXPECT_EQ(columnCount(lines[0]), columnCount(lines[1]));
    EXPECT_NE(lines[4].find("repeat 1,1,0,\"odd, \"\"name\"\"\",0,8"), std::string::npos) << lines[4];
    EXPECT_EQ(columnCount(lines[6]), columnCount(lines[0]));
    EXPECT_TRUE(lines[6].ends_with(",21.000000,,\r")) << lines[6];
}

TEST(ProfileJson, HasFiguresOfStagesKernelsAndWork) {
    const nlohmann::ordered_json json = profileToJson(handMadeProfile({1.0, 1.5, 2.0}));
    EXPECT_EQ(json.at("kernels").size(), 2u);
    const nlohmann::ordered_json &a = json.at("kernels").at(0);
    EXPECT_EQ(a.at("name"), "a");
    EXPECT_EQ(a.at("frameMillis"), (std::vector<double>{40.0, 60.0, 80.0}));
    EXPECT_EQ(a.at("rays").at("total"), 6680);
    EXPECT_EQ(json.at("work").at("rays").at("primary"), 3000);
    EXPECT_EQ(json.at("frameMillis").size(), 3u);
    EXPECT_EQ(json.at("stages").at(0).at("name"), "load");
    EXPECT_FALSE(json.at("stages").at(0).contains("firstMillis"));
    EXPECT_EQ(json.at("settings").at("spp"), 4);
    EXPECT_EQ(json.at("deviceBytes"), 2500);
}

TEST(ProfileStart, IsColdOnce) {
    const Profile profile = handMadeProfile({1.0, 1.2, 1.4}); // the warm-up took three times as long
    const StartSummary cold = summariseColdStart(profile);
    ASSERT_EQ(cold.stages.size(), 3u);
    EXPECT_EQ(cold.stages[0].name, "load");
    EXPECT_DOUBLE_EQ(cold.stages[0].millis, 2.0);
    EXPECT_EQ(cold.stages[2].name, "dispatches");
    EXPECT_DOUBLE_EQ(cold.stages[2].millis, 183.0);
    EXPECT_DOUBLE_EQ(cold.millis, 2.0 + 190.0) << "writing comes later";
    const std::optional<StartSummary> warm = summariseWarmFrame(profile);
    ASSERT_TRUE(warm);
    EXPECT_DOUBLE_EQ(warm->millis, 82.0);
    ASSERT_EQ(warm->stages.size(), 2u);
    EXPECT_DOUBLE_EQ(warm->stages[1].millis, 75.0);
}

TEST(ProfileStart, OfAMeasuredFirstFrameIsNotWarm) {
    Profile profile = handMadeProfile({1.0, 1.2});
    profile.frames.erase(profile.frames.begin());
    EXPECT_DOUBLE_EQ(summariseColdStart(profile).millis, 2.0 + 70.0);
    EXPECT_DOUBLE_EQ(summariseWarmFrame(profile).value().millis, 82.0 - 6.0 + 6.0);
    profile.frames.pop_back();
    EXPECT_FALSE(summariseWarmFrame(profile));
}

} // namespace
} // namespace hyalite::core
