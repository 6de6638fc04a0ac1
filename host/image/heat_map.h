// Error maps as pictures: black, purple, orange, pale yellow.
#pragma once

#include "host/image/error_map.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hyalite::core {

/// The colour of an error in [0, 1] as display-encoded R, G, B: the map "magma" of N. Smith and S. van der Walt (CC0),
/// in which FLIP's authors show errors. Errors outside are clamped; NaN is shown as 1, so that it stands out.
/// Interpolated between 18 colours of the original table of 256, within 3 levels of it.
[[nodiscard]] std::array<std::uint8_t, 3> magma(float error);

/// Three bytes a pixel, as writePng() takes them.
[[nodiscard]] std::vector<std::uint8_t> heatMap(const ErrorMap &map);

} // namespace hyalite::core
