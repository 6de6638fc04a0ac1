// A quantity of each pixel in false colours, with a legend that says which colour is how much.
#pragma once

#include "host/image/bitmap_text.h"

#include <span>
#include <string>

namespace hyalite {

/// The end of a scale from 0 on which almost all values lie: a round number, and not less than 99 of 100 values, so
/// that a few pixels do not darken all others. Values are finite and not negative.
[[nodiscard]] double scaleEndFor(std::span<const float> values);

/// The values, row by row from the top left, in the colours of magma(): brighter is more, and whatever lies beyond the
/// scale's end has its colour. Below them is the legend: the colours with numbers, what `quantity` is, and the largest
/// value. Small pictures get a margin, so that there is room for it.
[[nodiscard]] Drawing falseColours(int width, int height, std::span<const float> values,
                                   const std::string &quantity);

} // namespace hyalite
