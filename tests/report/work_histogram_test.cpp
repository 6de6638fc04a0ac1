#include "host/report/work_histogram.h"

#include <gtest/gtest.h>

#include <array>

namespace hyalite::core {
namespace {

TEST(WorkHistogram, HasBinsOfPowersOfTwo) {
    const std::vector<WorkBin> bins = binWork(std::array{0.0f, 0.5f, 1.0f, 1.9f, 2.0f, 9.0f, 15.9f});
    ASSERT_EQ(bins.size(), 5u);
    EXPECT_EQ(bins[0].begin, 0.0);
    EXPECT_EQ(bins[0].end, 1.0);
    const std::array<std::uint64_t, 5> wanted{2, 2, 1, 0, 2};
    for (std::size_t i = 0; i < bins.size(); ++i) {
        EXPECT_EQ(bins[i].pixelCount, wanted[i]) << i;
        if (i > 0) {
            EXPECT_EQ(bins[i].begin, bins[i - 1].end);
            EXPECT_EQ(bins[i].end, 2.0 * std::max(bins[i].begin, 0.5));
        }
    }
}

TEST(WorkHistogram, BeginsWhereThereArePixels) {
    const std::vector<WorkBin> bins = binWork(std::array{100.0f, 64.0f});
    ASSERT_EQ(bins.size(), 1u);
    EXPECT_EQ(bins[0].begin, 64.0);
    EXPECT_EQ(bins[0].end, 128.0);
    EXPECT_EQ(bins[0].pixelCount, 2u);
    EXPECT_TRUE(binWork({}).empty());
}

} // namespace
} // namespace hyalite::core
