// The mean radiance of a picture, and whether it is a closed form's.
#pragma once

#include "host/reference/renderer.h"
#include "tests/unit/geometry_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyalite::testing {

/// Of the green channel of all pixels.
struct Estimate {
    double mean;
    double
        error; ///< standard deviation of the mean, from the pixels, whose samples are stratified each for itself
};

[[nodiscard]] inline Estimate estimate(const Scene &scene,
                                       reference::Precision precision = reference::Precision::Float32) {
    const Crop crop{0, scene.camera.width, 0, scene.camera.height};
    const Image image =
        reference::render(packed(scene), scene.settings, crop, {.precision = precision}).film.toImage();
    double sum = 0.0;
    double squares = 0.0;
    for (const glm::vec3 &pixel : image.pixels()) {
        sum += pixel.y;
        squares += static_cast<double>(pixel.y) * pixel.y;
    }
    const double count = static_cast<double>(image.pixels().size());
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / (count - 1.0))};
}

/// Within `tolerance` of the closed form, relatively, and within 4 standard deviations where there is noise.
inline void expectRadiance(const Scene &scene, double expected, double tolerance = 1e-3) {
    const Estimate found = estimate(scene);
    EXPECT_NEAR(found.mean, expected, tolerance * expected);
    EXPECT_LT(std::abs(found.mean - expected), 4.0 * found.error + 2e-5 * expected)
        << found.mean << " +- " << found.error << " instead of " << expected;
}

} // namespace hyalite::testing
