// Signals that are caught, and those that are not any more.
#include "host/process/signals.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <thread>

#include <unistd.h>

namespace hyalite::core {
namespace {

void waitForTheEcho() {
    std::this_thread::sleep_for(std::chrono::duration<double>(1.5 * CaughtSignals::echoSeconds));
}

/// In a process of its own: ends it with 1 where `isRight` is false, and with 0 otherwise.
[[noreturn]] void exitWith(bool isRight) { _exit(isRight ? 0 : 1); }

TEST(StopDeathTest, TheFirstSignalIsNotedAndItsEchoOverheard) {
    EXPECT_EXIT(
        {
            CaughtSignals signals(true);
            signals.keepResults();
            const bool wasNone = signals.first() == 0;
            std::raise(SIGTERM);
            std::raise(SIGTERM);
            std::raise(SIGINT);
            exitWith(wasNone && signals.first() == SIGTERM);
        },
        ::testing::ExitedWithCode(0), "");
}

TEST(StopDeathTest, TheFirstSignalIsAnsweredUnlessQuiet) {
    EXPECT_EXIT(
        {
            CaughtSignals signals(false);
            signals.keepResults();
            std::raise(SIGINT);
            exitWith(signals.first() == SIGINT);
        },
        ::testing::ExitedWithCode(0), "^stopping .*\n$");
    EXPECT_EXIT(
        {
            CaughtSignals signals(true);
            signals.keepResults();
            std::raise(SIGINT);
            exitWith(true);
        },
        ::testing::ExitedWithCode(0), "^$");
}

TEST(StopDeathTest, AnotherSignalEndsTheProgram) {
    for (const int first : {SIGINT, SIGTERM})
        for (const int second : {SIGINT, SIGTERM})
            EXPECT_EXIT(
                {
                    CaughtSignals signals(true);
                    signals.keepResults();
                    std::raise(first);
                    waitForTheEcho();
                    std::raise(second);
                    exitWith(false);
                },
                ::testing::KilledBySignal(second), "");
}

TEST(StopDeathTest, BeforeThereAreResultsASignalEndsTheProgram) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        EXPECT_EXIT(
            {
                const CaughtSignals signals(true);
                std::raise(signal);
                exitWith(false);
            },
            ::testing::KilledBySignal(signal), "");
}

TEST(StopDeathTest, AfterwardsSignalsDoWhatTheyDidBefore) {
    EXPECT_EXIT(
        {
            std::optional<CaughtSignals> signals;
            signals.emplace(true);
            signals->keepResults();
            std::raise(SIGINT);
            signals.reset();
            std::raise(SIGINT);
            exitWith(false);
        },
        ::testing::KilledBySignal(SIGINT), "");
}

TEST(StopDeathTest, WhatWasIgnoredStaysIgnored) {
    EXPECT_EXIT(
        {
            std::signal(SIGINT, SIG_IGN);
            const CaughtSignals signals(true);
            std::raise(SIGINT);
            exitWith(signals.first() == 0);
        },
        ::testing::ExitedWithCode(0), "");
}

TEST(StopDeathTest, AMessageThatNobodyReadsLosesNothing) {
    EXPECT_EXIT(
        {
            int ends[2];
            const bool isReady = pipe(ends) == 0 && dup2(ends[1], STDERR_FILENO) == STDERR_FILENO;
            close(ends[0]);
            CaughtSignals signals(false);
            signals.keepResults();
            std::raise(SIGINT);
            exitWith(isReady && signals.first() == SIGINT);
        },
        ::testing::ExitedWithCode(0), "");
}

} // namespace
} // namespace hyalite::core
