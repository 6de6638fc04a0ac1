// Hard inputs: their exact results are as close as possible to the midpoint between two floats.
#pragma once

#include "shaders/layout/check_records.h"

#include <cstddef>
#include <vector>

namespace hyalite::core::gpu {

/// `count` inputs, the same in each run. With the significands A and B as integers, 2^k A and (2n + 1) B differ by 1
/// or 3; and 2^k times the significand of the square and (2n + 1)^2 by an integer of the order of the index. Sums,
/// products and integers lie on the midpoint or a last place beside it. All values and results are normal.
[[nodiscard]] std::vector<layout::HardInput> makeHardInputs(std::size_t count);

} // namespace hyalite::core::gpu
