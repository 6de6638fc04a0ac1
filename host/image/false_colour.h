// False colours for a quantity of each pixel, with a legend.
#pragma once

#include "host/image/bitmap_text.h"

#include <span>
#include <string>

namespace hyalite::core {

/// The end of a scale from 0: a round number, not below 99 % of the values, so that a few pixels do not darken all
/// others. Values are finite and not negative.
[[nodiscard]] double scaleEndFor(std::span<const float> values);

/// The values, row by row from the top left, in the colours of magma(): brighter is more; values beyond the end of the
/// scale have its last colour. Below is the legend: colours with numbers, the name of the quantity, and the largest
/// value. Small pictures get a margin to make room for it.
[[nodiscard]] Drawing falseColours(int width, int height, std::span<const float> values,
                                   const std::string &quantity);

} // namespace hyalite::core
