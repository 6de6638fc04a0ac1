// The start-up check, and what is concluded from it.
#include "host/gpu/startup_check.h"

#include "host/gpu/arithmetic.h"
#include "host/gpu/hard_inputs.h"
#include "tests/kernels/probe_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace hyalite::core::testing {
namespace {

using gpu::Arithmetic;

gpu::StartupCheck checkOfProbe() { return gpu::checkDevice(probeDevice()); }

TEST(StartupCheck, FindsNothingWrongOnThisDriver) {
    const bool isListed = probeDevice().info().hasExactDivisionListed;
    const gpu::StartupCheck check = checkOfProbe();
    EXPECT_GT(check.divisionCount, 2000u);
    EXPECT_GT(check.otherCount, 6000u);
    if (isListed) {
        EXPECT_EQ(check.wrong.divisions, 0u);
    }
    EXPECT_EQ(check.wrong.others, 0u);
    EXPECT_EQ(check.consecutiveLanes, probeDevice().info().subgroupSize);
    EXPECT_EQ(gpu::chooseArithmetic(probeDevice().info(), check, Arithmetic::Automatic).isNative, isListed);
}

TEST(StartupCheck, RunsOurOperatorsWhereAskedForOrWhereTheDevicesAreWrong) {
    const gpu::DeviceInfo &info = probeDevice().info();
    EXPECT_FALSE(gpu::chooseArithmetic(info, {}, Arithmetic::Own).isNative);
    EXPECT_TRUE(gpu::chooseArithmetic(info, {}, Arithmetic::Native).isNative);
    gpu::StartupCheck check;
    check.wrong.divisions = 1;
    EXPECT_FALSE(gpu::chooseArithmetic(info, check, Arithmetic::Automatic).isNative);
}

TEST(StartupCheck, TrustsNoUnlistedDriver) {
    EXPECT_FALSE(gpu::isExactDivisionListed(0));
    gpu::DeviceInfo info = probeDevice().info();
    info.hasExactDivisionListed = false;
    EXPECT_FALSE(gpu::chooseArithmetic(info, {}, Arithmetic::Automatic).isNative);
}

TEST(StartupCheck, MeasuresBitsThatAreNotPromised) {
    gpu::DeviceInfo info = probeDevice().info();
    info.canRoundToNearestEven = info.canPreserveSignedZeroInfNan = true;
    EXPECT_EQ(gpu::guaranteeOf(info, {}).degree, gpu::BitDegree::Promised);
    info.canRoundToNearestEven = false;
    EXPECT_EQ(gpu::guaranteeOf(info, checkOfProbe()).degree, gpu::BitDegree::Measured);
    gpu::StartupCheck check;
    check.wrong.divisions = 1; // ours take their place
    EXPECT_EQ(gpu::guaranteeOf(info, check).degree, gpu::BitDegree::Measured);
    check.wrong.others = 1;
    EXPECT_EQ(gpu::guaranteeOf(info, check).degree, gpu::BitDegree::None);
}

TEST(StartupCheck, CountsEveryWrongResult) {
    const std::vector<layout::HardInput> inputs = gpu::makeHardInputs(100);
    std::vector<layout::CheckResult> right;
    for (const layout::HardInput &input : inputs) {
        layout::CheckResult result{};
        result.quotient = input.numerator / input.denominator;
        result.root = std::sqrt(input.square);
        result.sum = input.addend + input.otherAddend;
        result.difference = input.addend - input.otherAddend;
        result.product = input.factor * input.otherFactor;
        result.rounded = static_cast<float>(input.integer);
        result.truncated = static_cast<std::int32_t>(input.numerator);
        result.comparisons = (input.addend < input.otherAddend ? layout::isLess | layout::isAtMost : 0u) |
                             (result.sum > input.addend ? layout::isSumGreater : 0u) | layout::areZerosEqual |
                             layout::isZeroNotLess;
        right.push_back(result);
    }
    const auto expectWrong = [&](std::size_t divisions, std::size_t others, auto &&spoil) {
        std::vector<layout::CheckResult> results = right;
        spoil(results[20]);
        const gpu::WrongResults wrong = gpu::countWrongResults(inputs, results);
        EXPECT_EQ(wrong.divisions, divisions);
        EXPECT_EQ(wrong.others, others);
    };
    const auto next = [](float &value) { value = std::nextafter(value, 1e30f); };
    expectWrong(0, 0, [](layout::CheckResult &) {});
    expectWrong(1, 0, [&](layout::CheckResult &result) { next(result.quotient); });
    expectWrong(1, 0, [&](layout::CheckResult &result) { next(result.root); });
    expectWrong(0, 1, [&](layout::CheckResult &result) { next(result.sum); });
    expectWrong(0, 1, [&](layout::CheckResult &result) { next(result.difference); });
    expectWrong(0, 1, [&](layout::CheckResult &result) { next(result.product); });
    expectWrong(0, 1, [&](layout::CheckResult &result) { next(result.rounded); });
    expectWrong(0, 1, [&](layout::CheckResult &result) { ++result.truncated; });
    expectWrong(0, 1, [&](layout::CheckResult &result) { result.comparisons ^= layout::areZerosEqual; });
}

/// Where invocation i of a workgroup of 64 is: its subgroup and its lane.
std::uint32_t consecutiveLanes(auto &&placeOf) {
    std::vector<layout::CheckResult> results(128);
    for (std::uint32_t i = 0; i < results.size(); ++i)
        std::tie(results[i].subgroup, results[i].lane) = placeOf(i % 64);
    return gpu::countConsecutiveLanes(results, 64);
}

TEST(StartupCheck, FindsConsecutiveLanes) {
    using Place = std::pair<std::uint32_t, std::uint32_t>;
    EXPECT_EQ(consecutiveLanes([](std::uint32_t i) { return Place(i / 8, i % 8); }), 8u);
    EXPECT_EQ(consecutiveLanes([](std::uint32_t i) { return Place(0, i); }), 64u);
    EXPECT_EQ(consecutiveLanes([](std::uint32_t i) { return Place(i, 0); }), 1u);
    EXPECT_EQ(consecutiveLanes([](std::uint32_t i) { return Place(0, i ^ 1); }), 1u) << "in another order";
    EXPECT_EQ(consecutiveLanes([](std::uint32_t i) { return Place(0, i ^ 2); }), 2u)
        << "pairs in another order";
    EXPECT_EQ(consecutiveLanes([](std::uint32_t i) { return Place(i / 12, i % 12); }), 4u) << "of parts";
    EXPECT_EQ(consecutiveLanes([](std::uint32_t i) { return Place(i % 8, i / 8); }), 1u)
        << "across subgroups";
}

} // namespace
} // namespace hyalite::core::testing
