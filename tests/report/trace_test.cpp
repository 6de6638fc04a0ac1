#include "host/report/trace_json.h"
#include "tests/fixtures/profile_fixture.h"
#include "tests/fixtures/trace_rules.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

using testing::expectTrace;
using testing::handMadeProfile;
using testing::traceSlices;

/// As readers see it.
nlohmann::json traceOf(const Profile &profile) {
    return nlohmann::json::parse(profileToTrace(profile).dump());
}

TEST(Trace, KeepsTheRulesOfItsFormat) {
    expectTrace(traceOf(handMadeProfile({1.0, 1.5, 2.0})));
    expectTrace(traceOf(handMadeProfile({0.0})));
}

TEST(Trace, HasASliceForEachDispatchWithItsArguments) {
    const nlohmann::json trace = traceOf(handMadeProfile({1.0}));
    const std::vector<nlohmann::json> dispatches = traceSlices(trace, "dispatch");
    ASSERT_EQ(dispatches.size(), 6u);
    const nlohmann::json &second = dispatches.at(4);
    EXPECT_EQ(second.at("name"), "a");
    EXPECT_EQ(second.at("args").at("tile"), "16x12 at (16, 8)");
    EXPECT_EQ(second.at("args").at("samples"), "0 to 4");
    EXPECT_EQ(second.at("args").at("resumed"), true);
    EXPECT_EQ(second.at("args").at("rays").at("shadow"), 2000);
    // The profile begins at 1 ms, the frame at 2000 ms.
    EXPECT_NEAR(second.at("ts").get<double>(), 2'015'500.0, 1.0);
    EXPECT_NEAR(second.at("dur").get<double>(), 30'000.0, 1e-6);
    EXPECT_EQ(traceSlices(trace, "submission").size(), 6u);
    EXPECT_EQ(traceSlices(trace, "frame").size(), 2u);
    EXPECT_EQ(traceSlices(trace, "stage").size(), 2u + 2u * 2u);
}

TEST(Trace, CountsRaysAndMemory) {
    const nlohmann::json trace = traceOf(handMadeProfile({1.0}));
    double maxBytes = 0.0;
    double lastSpeed = -1.0;
    double maxSpeed = 0.0;
    for (const nlohmann::json &event : trace.at("traceEvents")) {
        if (event.at("name") == "memory (bytes)")
            maxBytes = std::max(maxBytes, event.at("args").at("buffers").get<double>());
        if (event.at("name") != "Mray/s")
            continue;
        lastSpeed = event.at("args").at("shadow");
        maxSpeed = std::max(maxSpeed, lastSpeed);
    }
    EXPECT_EQ(maxBytes, 2500.0);
    EXPECT_DOUBLE_EQ(maxSpeed, 2000 / 1e6 / 0.010);
    EXPECT_EQ(lastSpeed, 0.0) << "when nothing runs, nothing is traced";
}

TEST(Trace, OfADeviceWithoutTimestampsShowsTheHostsTimes) {
    Profile profile = handMadeProfile({1.0});
    for (Frame &frame : profile.frames)
        for (DispatchRecord &dispatch : frame.timeline.dispatches)
            dispatch.times.device.reset();
    const nlohmann::json trace = traceOf(profile);
    expectTrace(trace);
    EXPECT_NEAR(traceSlices(trace, "dispatch").back().at("dur").get<double>(), 21'000.0, 1e-6);
    EXPECT_EQ(trace.at("otherData").at("clock"), "a clock");
}

} // namespace
} // namespace hyalite::core
