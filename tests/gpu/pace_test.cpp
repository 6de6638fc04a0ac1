#include "host/gpu/pace.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyalite::gpu {
namespace {

constexpr std::uint64_t fullTile = 256 * 256;
constexpr double wanted = 0.1; // seconds

/// A device on which a sample takes so much work, each part of which takes so long.
struct Work {
    double workPerSample;
    double workSeconds; ///< beside the others

    [[nodiscard]] double sampleSeconds() const { return workPerSample * workSeconds; }

    /// One dispatch of a tile of the size that the pace wants, of whose pixels each wants so many samples. Returns how
    /// long it took.
    double run(Pace &pace, std::uint32_t samples = 64) const {
        const std::uint64_t pixels = pace.pixels(samples);
        const double given =
            static_cast<double>(pixels) * static_cast<double>(std::min(pace.samples(pixels), samples));
        const double work = std::min(given * workPerSample, static_cast<double>(pace.work()));
        const double seconds = work * workSeconds;
        pace.learnWork(seconds, static_cast<std::uint64_t>(work));
        pace.learnSamples(seconds, static_cast<std::uint64_t>(work / workPerSample));
        return seconds;
    }
};

TEST(Pace, BeginsWithASmallTileAndLittleWork) {
    const Pace pace(wanted, 8, fullTile);
    EXPECT_EQ(pace.pixels(64), 1024u);
    EXPECT_EQ(pace.samples(1024), 32u);
    EXPECT_EQ(pace.work(), 1u << 20);
    EXPECT_EQ(Pace(wanted, 8, 64).pixels(64), 64u) << "no more than there are";
}

TEST(Pace, ComesAtOnceToTheTimeThatIsWanted) {
    for (const double workPerSample : {3.0, 30.0, 300.0, 3000.0})
        for (const double workSeconds : {1e-10, 1e-9, 1e-8}) {
            Pace pace(wanted, 8, fullTile);
            const Work work{workPerSample, workSeconds};
            (void)work.run(pace);
            const double seconds = work.run(pace);
            EXPECT_LE(seconds, 1.01 * wanted) << workPerSample << ' ' << workSeconds;
            // The largest tile with all of its samples is a reason for less, and whole samples are.
            const bool isAtLimit = pace.pixels(64) == fullTile && pace.samples(fullTile) >= 64;
            EXPECT_TRUE(isAtLimit || seconds >= 0.4 * wanted) << workPerSample << ' ' << workSeconds;
        }
}

// From nothing but background to the dearest of scenes.
TEST(Pace, NoDispatchIsLongHoweverCheapTheLastOnesWere) {
    const Work cheap{4.0, 2e-9};
    for (const double workPerSample : {50.0, 1000.0, 1e6}) {
        Pace pace(wanted, 8, fullTile);
        for (int i = 0; i < 50; ++i)
            (void)cheap.run(pace);
        EXPECT_EQ(pace.pixels(64), fullTile);
        const Work dear{workPerSample, 2e-9};
        for (int i = 0; i < 50; ++i)
            EXPECT_LE(dear.run(pace), 1.26 * wanted) << workPerSample << ' ' << i;
        EXPECT_LT(pace.pixels(64), fullTile);
    }
}

TEST(Pace, DearSamplesMakeTilesSmallAndThenGiveThemFewer) {
    Pace pace(wanted, 8, fullTile);
    pace.learnSamples(1.0, 1'000'000); // 100,000 samples in time
    EXPECT_EQ(pace.pixels(64), 3125u) << "with 32 samples at a time";
    EXPECT_EQ(pace.pixels(8), 12'500u);
    EXPECT_EQ(pace.samples(1024), 96u);
    Pace dearer(wanted, 8, fullTile);
    dearer.learnSamples(1.0, 100'000);
    EXPECT_EQ(dearer.pixels(64), 1024u);
    EXPECT_EQ(dearer.samples(1024), 8u);
    Pace dearest(wanted, 8, fullTile);
    dearest.learnSamples(1.0, 100);
    EXPECT_EQ(dearest.pixels(64), Pace::leastPixels);
    EXPECT_EQ(dearest.samples(Pace::leastPixels), 8u) << "whole rounds";
}

TEST(Pace, OneSlowDispatchIsForgotten) {
    Pace pace(wanted, 8, fullTile);
    const Work work{40.0, 1e-9};
    for (int i = 0; i < 20; ++i)
        (void)work.run(pace);
    const std::uint64_t before = pace.pixels(64);
    const std::uint32_t workBefore = pace.work();
    pace.learnWork(100.0, 1000); // as the machine was suspended
    pace.learnSamples(100.0, 1000);
    EXPECT_GE(pace.pixels(64), before / 5);
    EXPECT_GE(pace.work(), workBefore / 5);
    for (int i = 0; i < 40; ++i)
        (void)work.run(pace);
    EXPECT_NEAR(static_cast<double>(pace.pixels(64)), static_cast<double>(before), 2.0);
}

TEST(Pace, DispatchesWithoutWorkTellNothing) {
    Pace pace(wanted, 8, fullTile);
    pace.learnWork(1.0, 0);
    pace.learnWork(0.0, 1000);
    pace.learnSamples(1.0, 0);
    pace.learnSamples(0.0, 1000);
    EXPECT_EQ(pace.work(), 1u << 20);
    EXPECT_EQ(pace.pixels(64), 1024u);
}

TEST(Pace, AlwaysGivesWorkAndASample) {
    Pace pace(1e-9, 1, 64);
    for (int i = 0; i < 20; ++i) {
        pace.learnWork(1e6, 1);
        pace.learnSamples(1e6, 1);
    }
    EXPECT_EQ(pace.work(), 1u);
    EXPECT_EQ(pace.pixels(1), 64u);
    EXPECT_EQ(pace.samples(64), 1u);
    Pace idle(1e6, 8, fullTile);
    idle.learnWork(1e-12, 1'000'000);
    idle.learnSamples(1e-12, 1'000'000);
    EXPECT_EQ(idle.work(), 1u << 30);
    EXPECT_EQ(idle.samples(64), 1u << 16);
}

} // namespace
} // namespace hyalite::gpu
