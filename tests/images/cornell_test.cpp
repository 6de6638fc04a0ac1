// The Cornell box: its mean radiance is what paths find that are clever about nothing (plain_paths.h).
#include "tests/fixtures/test_extent.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/plain_comparison.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hyalite::core {
namespace {

using testing::Estimate;

void expectSameMean(const Film &film, const testing::Region &region, const Estimate &plain,
                    double relativeError) {
    const Estimate ours = testing::meanOf(film, region);
    for (int channel = 0; channel < 3; ++channel) {
        const double error = std::sqrt(ours.variance[channel] + plain.variance[channel]);
        EXPECT_LT(error, relativeError * plain.mean[channel]) << "too few samples to tell";
        EXPECT_NEAR(ours.mean[channel], plain.mean[channel], 4.0 * error)
            << "channel " << channel << " of columns " << region.x0 << " to " << region.x1 << ", rows "
            << region.y0 << " to " << region.y1;
    }
}

// In rows below the light: what is seen of it is a few bright pixels, and plain paths hit one of them now and then.
TEST(CornellBox, HasTheMeanRadianceOfPlainPaths) {
    const TestScene scene = testing::shippedScene("cornell", 32, 32, 256);
    const Film film = testing::renderOnDevice(scene).film;
    // The walls are red, white and green, and the floor has the shadows. All four quarters together are known best.
    Estimate whole;
    for (const int x : {0, 16})
        for (const int y : {8, 20}) {
            const Estimate plain = testing::estimatePlainly(scene, x, x + 16, y, y + 12,
                                                            testing::repetitions(200'000, 500'000), 1);
            expectSameMean(film, {x, x + 16, y, y + 12}, plain, testing::isTestingAll() ? 8e-3 : 13e-3);
            whole.mean += plain.mean / 4.0;
            whole.variance += plain.variance / 16.0;
        }
    expectSameMean(film, {0, 32, 8, 32}, whole, testing::isTestingAll() ? 2.5e-3 : 4e-3);
}

TEST(CornellBox, HasItForEachNumberOfSegments) {
    TestScene scene = testing::shippedScene("cornell", 16, 16, 512);
    for (const int depth : {2, 3, 5}) {
        scene.settings.maxDepth = depth;
        expectSameMean(
            testing::renderOnDevice(scene).film, {0, 16, 4, 16},
            testing::estimatePlainly(scene, 0, 16, 4, 16, testing::repetitions(120'000, 250'000), 1),
            testing::isTestingAll() ? 6e-3 : 9e-3);
    }
}

} // namespace
} // namespace hyalite::core
