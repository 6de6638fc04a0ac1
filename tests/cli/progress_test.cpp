// The time left, of tasks whose parts differ in cost, and what a progress line says.
#include "host/cli/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

namespace hyalite::core {
namespace {

TEST(TimeLeft, OfASteadyTaskIsExact) {
    TimeLeft timeLeft;
    for (int i = 1; i < 100; ++i)
        EXPECT_NEAR(timeLeft.update(0.1 * i, 0.01 * i).value(), 0.1 * (100 - i), 1e-9) << i;
}

TEST(TimeLeft, LeavesOutWhatWasBeforeTheWork) {
    TimeLeft timeLeft;
    timeLeft.begin(100.0, 0.25); // a driver compiled, and a checkpoint was resumed
    for (int i = 1; i <= 75; ++i)
        EXPECT_NEAR(timeLeft.update(100.0 + 0.1 * i, 0.25 + 0.01 * i).value(), 0.1 * (75 - i), 1e-6) << i;
}

TEST(TimeLeft, IsUnknownUntilWorkIsFinished) {
    TimeLeft timeLeft;
    EXPECT_FALSE(timeLeft.update(1.0, 0.0).has_value());
    EXPECT_TRUE(timeLeft.update(2.0, 0.1).has_value());
}

TEST(TimeLeft, FollowsASpeedThatChanges) {
    // The first half of the work takes 10 s, the second one 90 s.
    TimeLeft timeLeft;
    double left = 0.0;
    for (int i = 1; i <= 10; ++i)
        left = timeLeft.update(i, 0.05 * i).value();
    EXPECT_NEAR(left, 10.0, 1e-6) << "nothing else could be known";
    for (int second = 11; second <= 30; ++second)
        left = timeLeft.update(second, 0.5 + 0.5 * (second - 10) / 90.0).value();
    EXPECT_NEAR(left, 70.0, 1.0) << "the last half of the time was slow";
}

TEST(ProgressLine, SaysThatADriverCompilesIfItTakesLong) {
    for (const bool takesLong : {false, true}) {
        ::testing::internal::CaptureStderr();
        {
            ProgressLine progress("render", false);
            progress.expectCompiler();
            if (takesLong)
                std::this_thread::sleep_for(std::chrono::milliseconds(1500));
            progress.update(0.0);
        }
        const std::string said = ::testing::internal::GetCapturedStderr();
        EXPECT_EQ(said.starts_with("render: the driver compiles\n"), takesLong) << said;
    }
}

TEST(TimeLeft, IsUnknownWhenWorkStandsStill) {
    TimeLeft timeLeft;
    for (int second = 1; second <= 30; ++second)
        static_cast<void>(timeLeft.update(second, second < 10 ? 0.01 * second : 0.1));
    EXPECT_FALSE(timeLeft.update(31, 0.1).has_value());
}

} // namespace
} // namespace hyalite::core
