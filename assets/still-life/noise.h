// Smooth noise in space, the same on every machine.
#pragma once

#include "assets/still-life/vec.h"

#include <cstdint>

namespace still_life {

/// In [0, 1], with a grid of unit size. A period other than 0 repeats it along that axis; periods are whole numbers.
double noise(const Vec &at, const std::array<int, 3> &period = {0, 0, 0});

/// The sum of `octaves` of noise, each twice as fine and half as strong as the one before; in [0, 1].
double layeredNoise(const Vec &at, int octaves, const std::array<int, 3> &period = {0, 0, 0});

} // namespace still_life
