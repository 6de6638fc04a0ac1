// Error map: an error for each pixel, from a metric, for the heat map.
#pragma once

#include <vector>

namespace hyalite::core {

/// Errors in [0, 1], row by row from the top left.
struct ErrorMap {
    int width = 0;
    int height = 0;
    std::vector<float> errors;
};

} // namespace hyalite::core
