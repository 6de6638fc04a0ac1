#include "host/image/metrics.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

namespace hyalite::core {

namespace {

/// An order-preserving map of floats to integers: negative floats count down from the middle of the range, others up.
std::uint32_t positionOnNumberLine(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    constexpr std::uint32_t sign = 0x80000000u;
    return (bits & sign) != 0 ? ~bits : bits | sign;
}

double differenceOf(float a, float b) {
    if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b))
        return 0.0;
    if (!std::isfinite(a) || !std::isfinite(b))
        return std::numeric_limits<double>::infinity();
    return static_cast<double>(b) - static_cast<double>(a);
}

} // namespace

std::uint32_t ulpDistance(float a, float b) {
    const std::uint32_t positionA = positionOnNumberLine(a);
    const std::uint32_t positionB = positionOnNumberLine(b);
    return positionA > positionB ? positionA - positionB : positionB - positionA;
}

double PixelMetrics::psnrDecibels() const { return -10.0 * std::log10(meanSquaredError); }

PixelMetrics comparePixels(const Image &a, const Image &b, double outlierThreshold, const Mask &mask) {
    assert(a.width() == b.width() && a.height() == b.height());
    assert(mask.empty() || mask.size() == a.pixels().size());

    PixelMetrics metrics;
    double squareSum = 0.0;
    double absoluteSum = 0.0;
    double sum = 0.0;
    std::size_t worstIndex = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        if (!isCompared(mask, i))
            continue;
        ++metrics.pixelCount;
        double pixelMax = 0.0;
        std::uint32_t pixelUlps = 0;
        bool finite = true;
        for (int channel = 0; channel < 3; ++channel) {
            const float valueA = a.pixels()[i][channel];
            const float valueB = b.pixels()[i][channel];
            const double difference = differenceOf(valueA, valueB);
            sum += difference;
            absoluteSum += std::abs(difference);
            squareSum += difference * difference;
            pixelMax = std::max(pixelMax, std::abs(difference));
            pixelUlps = std::max(pixelUlps, ulpDistance(valueA, valueB));
            finite = finite && std::isfinite(valueA) && std::isfinite(valueB);
        }
        metrics.differingPixelCount += pixelUlps != 0 ? 1 : 0;
        metrics.outlierCount += pixelMax > outlierThreshold ? 1 : 0;
        metrics.nonFiniteCount += finite ? 0 : 1;
        metrics.maxUlpDistance = std::max(metrics.maxUlpDistance, pixelUlps);
        if (pixelMax > metrics.maxAbsoluteDifference) {
            metrics.maxAbsoluteDifference = pixelMax;
            worstIndex = i;
        }
    }
    assert(metrics.pixelCount > 0);

    const double channelCount = 3.0 * static_cast<double>(metrics.pixelCount);
    metrics.meanSquaredError = squareSum / channelCount;
    metrics.meanAbsoluteDifference = absoluteSum / channelCount;
    metrics.meanDifference =
        std::isfinite(absoluteSum) ? sum / channelCount : std::numeric_limits<double>::quiet_NaN();
    metrics.worstX = static_cast<int>(worstIndex % static_cast<std::size_t>(a.width()));
    metrics.worstY = static_cast<int>(worstIndex / static_cast<std::size_t>(a.width()));
    return metrics;
}

} // namespace hyalite::core
