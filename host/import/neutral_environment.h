// The neutral environment: what lights a glTF file that has no lights, as viewers do.
#pragma once

#include "host/image/image.h"

#include <string_view>

namespace hyalite::core {

/// Its name among files of environments; "./neutral" is a file of that name.
inline constexpr std::string_view neutralEnvironmentName = "neutral";

/// A soft, colourless studio, linear radiance by longitude and latitude (Environment): walls that grow brighter from
/// the floor, 0.25, to the ceiling, 0.75, and three soft boxes, large ones in front to the left and to the right and a
/// bright one above, behind the middle. Scaled so that the mean radiance from all directions is 0.7: a white matt
/// surface that faces nothing in particular has about that radiance, and one that faces up a third more.
[[nodiscard]] Image neutralEnvironment();

} // namespace hyalite::core
