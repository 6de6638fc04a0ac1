// Histogram of the work of a frame over its pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hyalite::core {

/// Pixels whose samples take [begin, end) tests, on average.
struct WorkBin {
    double begin = 0.0;
    double end = 0.0;
    std::uint64_t pixelCount = 0;
};

/// Bins [0, 1), [1, 2), [2, 4), [4, 8), ... from the first to the last that has a pixel. Values are finite and not
/// negative.
[[nodiscard]] std::vector<WorkBin> binWork(std::span<const float> testsPerSample);

} // namespace hyalite::core
