// One error for each pixel, as the metrics make it and the heat map shows it.
#pragma once

#include <vector>

namespace hyalite {

/// Errors in [0, 1], row by row from the top left.
struct ErrorMap {
    int width = 0;
    int height = 0;
    std::vector<float> errors;
};

} // namespace hyalite
