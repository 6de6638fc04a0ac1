// The Cornell box: its mean radiance is what paths find that are clever about nothing (plain_paths.h).
#include "tests/images/plain_comparison.h"
#include "tests/images/rendering.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hyalite {
namespace {

using testing::Estimate;

void expectSameMean(const Scene &scene, const Film &film, int x0, int x1, int y0, int y1, int pathCount,
                    double relativeError) {
    const Estimate ours = testing::meanOf(film, {x0, x1, y0, y1});
    const Estimate plain = testing::estimatePlainly(scene, x0, x1, y0, y1, pathCount, 1);
    for (int channel = 0; channel < 3; ++channel) {
        const double error = std::sqrt(ours.variance[channel] + plain.variance[channel]);
        EXPECT_LT(error, relativeError * plain.mean[channel]) << "too few samples to tell";
        EXPECT_NEAR(ours.mean[channel], plain.mean[channel], 4.0 * error)
            << "channel " << channel << " of columns " << x0 << " to " << x1 << ", rows " << y0 << " to "
            << y1;
    }
}

// In rows below the light: what is seen of it is a few bright pixels, and plain paths hit one of them now and then.
TEST(CornellBox, HasTheMeanRadianceOfPlainPaths) {
    const Scene scene = testing::shippedScene("cornell", 32, 32, 256);
    const Film film = testing::renderOnDevice(scene).film;
    expectSameMean(scene, film, 0, 32, 8, 32, 2'000'000, 2.5e-3);
    // The walls are red, white and green, and the floor has the shadows.
    for (const int x : {0, 16})
        for (const int y : {8, 20})
            expectSameMean(scene, film, x, x + 16, y, y + 12, 250'000, 1e-2);
}

TEST(CornellBox, HasItForEachNumberOfSegments) {
    Scene scene = testing::shippedScene("cornell", 16, 16, 512);
    for (const int depth : {2, 3, 5}) {
        scene.settings.maxDepth = depth;
        expectSameMean(scene, testing::renderOnDevice(scene).film, 0, 16, 4, 16, 250'000, 6e-3);
    }
}

} // namespace
} // namespace hyalite
