// Hard inputs: their quotients and square roots are as close as possible to the midpoint between two floats.
#pragma once

#include <cstddef>
#include <vector>

namespace hyalite::gpu {

struct HardInput {
    float numerator;
    float denominator;
    float square; ///< its root is hard to round
};

/// `count` inputs, the same in each run. With the significands A and B as integers, 2^k A and (2n + 1) B differ by 1
/// or 3; and 2^k times the significand of the square and (2n + 1)^2 by an integer of the order of the index. All
/// values, quotients and roots are normal.
[[nodiscard]] std::vector<HardInput> makeHardInputs(std::size_t count);

} // namespace hyalite::gpu
