#include "host/gpu/dispatch_sizer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyalite::core::gpu {
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
    double run(DispatchSizer &sizer, std::uint32_t samples = 64) const {
        const std::uint64_t pixels = sizer.pixels(samples);
        const double given =
            static_cast<double>(pixels) * static_cast<double>(std::min(sizer.samples(pixels), samples));
        const double work = std::min(given * workPerSample, static_cast<double>(sizer.work()));
        const double seconds = work * workSeconds;
        sizer.learnWork(seconds, static_cast<std::uint64_t>(work));
        sizer.learnSamples(seconds, static_cast<std::uint64_t>(work / workPerSample));
        return seconds;
    }
};

TEST(DispatchSizer, BeginsWithASmallTileAndLittleWork) {
    const DispatchSizer sizer(wanted, 8, fullTile);
    EXPECT_EQ(sizer.pixels(64), 1024u);
    EXPECT_EQ(sizer.samples(1024), 32u);
    EXPECT_EQ(sizer.work(), 1u << 20);
    EXPECT_EQ(DispatchSizer(wanted, 8, 64).pixels(64), 64u) << "no more than there are";
}

TEST(DispatchSizer, ComesAtOnceToTheTimeThatIsWanted) {
    for (const double workPerSample : {3.0, 30.0, 300.0, 3000.0})
        for (const double workSeconds : {1e-10, 1e-9, 1e-8}) {
            DispatchSizer sizer(wanted, 8, fullTile);
            const Work work{workPerSample, workSeconds};
            (void)work.run(sizer);
            const double seconds = work.run(sizer);
            EXPECT_LE(seconds, 1.01 * wanted) << workPerSample << ' ' << workSeconds;
            // The largest tile with all of its samples is a reason for less, and whole samples are.
            const bool isAtLimit = sizer.pixels(64) == fullTile && sizer.samples(fullTile) >= 64;
            EXPECT_TRUE(isAtLimit || seconds >= 0.4 * wanted) << workPerSample << ' ' << workSeconds;
        }
}

// From nothing but background to the dearest of scenes.
TEST(DispatchSizer, NoDispatchIsLongHoweverCheapTheLastOnesWere) {
    const Work cheap{4.0, 2e-9};
    for (const double workPerSample : {50.0, 1000.0, 1e6}) {
        DispatchSizer sizer(wanted, 8, fullTile);
        for (int i = 0; i < 50; ++i)
            (void)cheap.run(sizer);
        EXPECT_EQ(sizer.pixels(64), fullTile);
        const Work dear{workPerSample, 2e-9};
        for (int i = 0; i < 50; ++i)
            EXPECT_LE(dear.run(sizer), 1.26 * wanted) << workPerSample << ' ' << i;
        EXPECT_LT(sizer.pixels(64), fullTile);
    }
}

TEST(DispatchSizer, DearSamplesMakeTilesSmallAndThenGiveThemFewer) {
    DispatchSizer sizer(wanted, 8, fullTile);
    sizer.learnSamples(1.0, 1'000'000); // 100,000 samples in time
    EXPECT_EQ(sizer.pixels(64), 3125u) << "with 32 samples at a time";
    EXPECT_EQ(sizer.pixels(8), 12'500u);
    EXPECT_EQ(sizer.samples(1024), 96u);
    DispatchSizer dearer(wanted, 8, fullTile);
    dearer.learnSamples(1.0, 100'000);
    EXPECT_EQ(dearer.pixels(64), 1024u);
    EXPECT_EQ(dearer.samples(1024), 8u);
    DispatchSizer dearest(wanted, 8, fullTile);
    dearest.learnSamples(1.0, 100);
    EXPECT_EQ(dearest.pixels(64), DispatchSizer::minPixels);
    EXPECT_EQ(dearest.samples(DispatchSizer::minPixels), 8u) << "whole rounds";
}

TEST(DispatchSizer, OneSlowDispatchIsForgotten) {
    DispatchSizer sizer(wanted, 8, fullTile);
    const Work work{40.0, 1e-9};
    for (int i = 0; i < 20; ++i)
        (void)work.run(sizer);
    const std::uint64_t before = sizer.pixels(64);
    const std::uint32_t workBefore = sizer.work();
    sizer.learnWork(100.0, 1000); // as the machine was suspended
    sizer.learnSamples(100.0, 1000);
    EXPECT_GE(sizer.pixels(64), before / 5);
    EXPECT_GE(sizer.work(), workBefore / 5);
    for (int i = 0; i < 40; ++i)
        (void)work.run(sizer);
    EXPECT_NEAR(static_cast<double>(sizer.pixels(64)), static_cast<double>(before), 2.0);
}

TEST(DispatchSizer, DispatchesWithoutWorkTellNothing) {
    DispatchSizer sizer(wanted, 8, fullTile);
    sizer.learnWork(1.0, 0);
    sizer.learnWork(0.0, 1000);
    sizer.learnSamples(1.0, 0);
    sizer.learnSamples(0.0, 1000);
    EXPECT_EQ(sizer.work(), 1u << 20);
    EXPECT_EQ(sizer.pixels(64), 1024u);
}

TEST(DispatchSizer, AlwaysGivesWorkAndASample) {
    DispatchSizer sizer(1e-9, 1, 64);
    for (int i = 0; i < 20; ++i) {
        sizer.learnWork(1e6, 1);
        sizer.learnSamples(1e6, 1);
    }
    EXPECT_EQ(sizer.work(), 1u);
    EXPECT_EQ(sizer.pixels(1), 64u);
    EXPECT_EQ(sizer.samples(64), 1u);
    DispatchSizer idle(1e6, 8, fullTile);
    idle.learnWork(1e-12, 1'000'000);
    idle.learnSamples(1e-12, 1'000'000);
    EXPECT_EQ(idle.work(), 1u << 30);
    EXPECT_EQ(idle.samples(64), 1u << 16);
}

} // namespace
} // namespace hyalite::core::gpu
