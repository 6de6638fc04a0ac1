// The filter of pixels: its table against its formula, and samples drawn through it against both.
#include "host/packing/pixel_filter.h"
#include "tests/fixtures/leaves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace hyalite::core {
namespace {

/// The window as it is tabled, not integrated; `x` in pixels from its middle.
double window(double x) {
    const double angle = 2.0 * std::numbers::pi * (0.5 + 0.5 * x / filterRadius);
    return 0.35875 - 0.48829 * std::cos(angle) + 0.14128 * std::cos(2.0 * angle) -
           0.01168 * std::cos(3.0 * angle);
}

/// A scene with nothing but the filter.
PackedScene filterAlone() {
    PackedScene packed;
    packed.lookups.resize(5); // what comes before it
    packFilter(packed);
    return packed;
}

TEST(PixelFilter, ItsShareIsTheIntegralOfTheWindow) {
    constexpr int steps = 3000;
    const double width = 2.0 * filterRadius / steps;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        EXPECT_NEAR(filterShareBelow(-filterRadius + i * width), sum, 1e-6) << i;
        sum += window(-filterRadius + (i + 0.5) * width) * width / (2.0 * filterRadius * 0.35875);
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_EQ(filterShareBelow(-2.0), 0.0);
    EXPECT_EQ(filterShareBelow(2.0), 1.0);
}

TEST(PixelFilter, QuantilesAreTheInverseOfTheShare) {
    const PackedScene packed = filterAlone();
    ASSERT_EQ(packed.frame.filterTexels, 5u);
    ASSERT_EQ(packed.lookups.size(), 5u + layout::filterCellCount);
    for (int i = 0; i < 10'000; ++i) {
        const double u = i / 10'000.0;
        const double x = reference::filterQuantile(reference::SceneView<double>(packed), u) - 0.5;
        // Straight between the ends of a cell: a share is off by less than half of one.
        EXPECT_NEAR(filterShareBelow(x), u, 0.5 / layout::filterCellCount) << u;
        const double ofCell = u * layout::filterCellCount;
        if (ofCell == std::floor(ofCell)) {
            EXPECT_NEAR(filterShareBelow(x), u, 1e-6) << u;
        }
    }
    const float last = std::nextafter(1.0f, 0.0f);
    EXPECT_NEAR(reference::filterQuantile(reference::SceneView<float>(packed), 0.0f), 0.5 - filterRadius,
                1e-6);
    EXPECT_NEAR(reference::filterQuantile(reference::SceneView<float>(packed), last), 0.5 + filterRadius,
                1e-4);
}

TEST(PixelFilter, SamplesAreAsDenseAsTheFilterIsHigh) {
    const PackedScene packed = filterAlone();
    constexpr int binCount = 30;
    constexpr std::uint32_t pixels = 64;
    constexpr std::uint32_t samplesPerPixel = 1024;
    std::vector<double> found(binCount, 0.0);
    double mean = 0.0;
    double square = 0.0;
    for (std::uint32_t p = 0; p < pixels; ++p)
        for (std::uint32_t i = 0; i < samplesPerPixel; ++i) {
            const reference::Vec2<float> u =
                reference::samplePixel<float>(layout::samplerFiltered, {p, 3 * p}, i, 7);
            const double x =
                static_cast<double>(reference::filterQuantile(reference::SceneView<float>(packed), u.x)) -
                0.5;
            ++found[std::min(static_cast<std::size_t>((x + filterRadius) / (2.0 * filterRadius) * binCount),
                             std::size_t{binCount - 1})];
            mean += x;
            square += x * x;
        }
    const double count = static_cast<double>(pixels) * samplesPerPixel;
    double wantedSquare = 0.0;
    for (int bin = 0; bin < binCount; ++bin) {
        const double begin = -filterRadius + 2.0 * filterRadius * bin / binCount;
        const double end = begin + 2.0 * filterRadius / binCount;
        const double wanted = count * (filterShareBelow(end) - filterShareBelow(begin));
        const double cell = count / layout::filterCellCount; // within one all are alike
        EXPECT_NEAR(found[static_cast<std::size_t>(bin)], wanted, 4.0 * std::sqrt(wanted + 1.0) + 0.5 * cell)
            << bin;
        wantedSquare += wanted / count * 0.25 * (begin + end) * (begin + end);
    }
    EXPECT_NEAR(mean / count, 0.0, 1e-3);
    EXPECT_NEAR(square / count, wantedSquare, 0.02 * wantedSquare);
}

} // namespace
} // namespace hyalite::core
