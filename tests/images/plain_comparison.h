// Comparison of both renderers with the plain path tracer by z-tests of mean radiance over regions of the image.
#pragma once

#include "host/film/film.h"
#include "tests/fixtures/test_scene.h"
#include "tests/images/plain_paths.h"

#include <vector>

namespace hyalite::core::testing {

/// Columns [x0, x1) and rows [y0, y1).
struct Region {
    int x0;
    int x1;
    int y0;
    int y1;
};

/// The mean of a region of a film that shows the whole image. Samples of a pixel are stratified: they vary less than
/// the variance says, which makes the test careful.
[[nodiscard]] Estimate meanOf(const Film &film, const Region &region);

struct Comparison {
    std::vector<Region> regions;
    int pathCount = 120'000; ///< for each region
    double errorLimit =
        0.012; ///< most that one standard error may be of the mean: above, the test sees too little
    double allowance =
        5e-4; ///< share of the mean that may differ beside noise: float32, 2^-32 steps of probabilities
    Search search = Search::ByScattering;
};

/// Of what facets send to each other the renderers interpolate tables of 32 by 32 energies, linearly. A white metal
/// then reflects everything within 0.3 % (assets/README.md).
constexpr double energyAllowance = 3e-3;

/// Expects the film to have the same mean radiance in each region and channel.
void expectPlainRadiance(const char *renderer, const Film &film, const TestScene &scene,
                         const Comparison &comparison);

/// Likewise of the film of the CPU, which has the device's bits (tests of twins); and of the device's if everything is
/// tested.
void expectPlainRadiance(const TestScene &scene, const Comparison &comparison);

} // namespace hyalite::core::testing
