#include "host/base/summary.h"

#include <gtest/gtest.h>

#include <vector>

namespace hyalite::core {
namespace {

TEST(Statistics, QuantilesLieBetweenTheirNeighbours) {
    const std::vector<double> values{40.0, 10.0, 20.0, 30.0, 50.0};
    EXPECT_DOUBLE_EQ(quantile(values, 0.0), 10.0);
    EXPECT_DOUBLE_EQ(quantile(values, 0.25), 20.0);
    EXPECT_DOUBLE_EQ(quantile(values, 0.5), 30.0);
    EXPECT_DOUBLE_EQ(quantile(values, 0.625), 35.0);
    EXPECT_DOUBLE_EQ(quantile(values, 1.0), 50.0);
    EXPECT_DOUBLE_EQ(quantile(std::vector<double>{7.0}, 0.95), 7.0);
}

TEST(Statistics, AnEvenNumberOfValuesHasItsMedianInTheMiddle) {
    EXPECT_DOUBLE_EQ(quantile(std::vector<double>{1.0, 4.0, 2.0, 3.0}, 0.5), 2.5);
}

TEST(Statistics, SummaryHasAllItsParts) {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i)
        values.push_back(i);
    const Summary summary = summarise(values);
    EXPECT_EQ(summary.count, 101u);
    EXPECT_DOUBLE_EQ(summary.total, 5050.0);
    EXPECT_DOUBLE_EQ(summary.min, 0.0);
    EXPECT_DOUBLE_EQ(summary.median, 50.0);
    EXPECT_DOUBLE_EQ(summary.p95, 95.0);
    EXPECT_DOUBLE_EQ(summary.max, 100.0);
    EXPECT_EQ(summarise({}).count, 0u);
}

TEST(Statistics, SpreadIsHalfTheQuartilesDistance) {
    EXPECT_DOUBLE_EQ(relativeSpread(std::vector<double>{80.0, 90.0, 100.0, 110.0, 120.0}), 0.1);
    EXPECT_DOUBLE_EQ(relativeSpread(std::vector<double>{100.0, 100.0, 100.0}), 0.0);
    EXPECT_DOUBLE_EQ(relativeSpread(std::vector<double>{100.0}), 0.0) << "one value has no spread";
    EXPECT_DOUBLE_EQ(relativeSpread(std::vector<double>{0.0, 0.0}), 0.0);
    // One wild value among many leaves it as it is.
    EXPECT_LT(relativeSpread(std::vector<double>{100.0, 101.0, 100.0, 99.0, 100.0, 100.0, 5000.0}), 0.01);
}

} // namespace
} // namespace hyalite::core
