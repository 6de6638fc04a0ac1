#include "host/gpu/pace.h"

#include <gtest/gtest.h>

namespace hyalite::gpu {
namespace {

TEST(Pace, TakesFewerSamplesThenFewerSteps) {
    Pace pace(0.1, 8, 4096);
    EXPECT_EQ(pace.samples(), 32u);
    EXPECT_EQ(pace.steps(), 4096u);
    for (const std::uint32_t samples : {16u, 8u}) {
        pace.learn(0.5);
        EXPECT_EQ(pace.samples(), samples);
        EXPECT_EQ(pace.steps(), 4096u);
    }
    for (const std::uint32_t steps : {2048u, 1024u, 512u, 256u, 256u}) {
        pace.learn(0.5);
        EXPECT_EQ(pace.samples(), 8u);
        EXPECT_EQ(pace.steps(), steps);
    }
}

TEST(Pace, TakesMoreWhereThereIsTime) {
    Pace pace(0.1, 1, 1024);
    for (int i = 0; i < 7; ++i)
        pace.learn(1.0);
    EXPECT_EQ(pace.samples(), 1u);
    EXPECT_EQ(pace.steps(), 256u);
    pace.learn(0.01);
    EXPECT_EQ(pace.steps(), 512u);
    pace.learn(0.01);
    EXPECT_EQ(pace.steps(), 1024u);
    pace.learn(0.01);
    EXPECT_EQ(pace.samples(), 2u);
    for (int i = 0; i < 100; ++i)
        pace.learn(0.0);
    EXPECT_EQ(pace.samples(), 1u << 16);
    EXPECT_EQ(pace.steps(), 1024u);
}

TEST(Pace, LeavesWhatFits) {
    Pace pace(0.1, 8, 4096);
    for (const double seconds : {0.04, 0.07, 0.1})
        pace.learn(seconds);
    EXPECT_EQ(pace.samples(), 32u);
    EXPECT_EQ(pace.steps(), 4096u);
}

TEST(Pace, NeverTakesFewerStepsThanWereAskedFor) {
    Pace pace(0.1, 1, 20);
    for (int i = 0; i < 20; ++i)
        pace.learn(1.0);
    EXPECT_EQ(pace.steps(), 20u);
}

} // namespace
} // namespace hyalite::gpu
