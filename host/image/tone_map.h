// From linear radiance to the 8-bit values of a picture file.
#pragma once

#include "host/image/image.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hyalite {

/// Entry i - 1 is the smallest float c with 255 * c^(1/2.2) >= i - 1/2: the smallest that is shown as level i.
/// Ascending; i = 1..255.
[[nodiscard]] const std::array<float, 255> &toneMapThresholds();

/// 255 * clamp(c, 0, 1)^(1/2.2), rounded to nearest. NaN is shown as 0, like everything that is not positive.
[[nodiscard]] std::uint8_t encodeLevel(float linear);

/// Three bytes R, G, B a pixel, row by row from the top left: encodeLevel(c * 2^exposureStops), where the product
/// is rounded to float. `exposureStops` is finite. The same bytes on every machine.
[[nodiscard]] std::vector<std::uint8_t> toneMap(const Image &image, double exposureStops);

} // namespace hyalite
