// Tallies count the samples of each number.
#include "host/film/tally.h"

#include <gtest/gtest.h>

namespace hyalite::core {
namespace {

TEST(Tally, CountsNumbersInTheOrderInWhichTheyCome) {
    layout::FilmPixel pixel{};
    for (const std::uint32_t number : {5u, 0u, 3u, 5u, 16'777'216u, 5u})
        tallySample(pixel, number);
    const Tally tally = tallyOf(pixel);
    EXPECT_EQ(pixel.sampleCount, 6u) << "as in any film";
    EXPECT_EQ(tally.sampleCount, 6u);
    EXPECT_EQ(tally.othersCount, 0u);
    ASSERT_EQ(tally.numbers.size(), 3u);
    EXPECT_EQ(tally.numbers[0].number, 5u);
    EXPECT_EQ(tally.numbers[0].count, 3u);
    EXPECT_EQ(tally.numbers[1].number, 3u);
    EXPECT_EQ(tally.numbers[2].number, 16'777'216u);
    EXPECT_EQ(tally.numbers[2].count, 1u);
}

TEST(Tally, CountsTogetherWhatComesTooLate) {
    layout::FilmPixel pixel{};
    for (std::uint32_t sample = 0; sample < 20; ++sample)
        tallySample(pixel, sample % 10 + 1);
    const Tally tally = tallyOf(pixel);
    ASSERT_EQ(tally.numbers.size(), layout::tallyNumbers);
    for (std::uint32_t i = 0; i < layout::tallyNumbers; ++i) {
        EXPECT_EQ(tally.numbers[i].number, i + 1);
        EXPECT_EQ(tally.numbers[i].count, 2u);
    }
    EXPECT_EQ(tally.othersCount, 6u);
    EXPECT_EQ(tally.sampleCount, 20u);
}

} // namespace
} // namespace hyalite::core
