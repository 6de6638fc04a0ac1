// IES files: photometric profiles of lamps (IESNA LM-63 of 1986, 1991, 1995, 2002 and 2019), type C.
#pragma once

#include "host/base/input_file.h"
#include "host/scene/light_profile.h"

#include <string>
#include <vector>

namespace hyalite::core {

struct IesFile {
    LightProfile profile;
    std::vector<std::string> warnings;
};

/// The profile of all directions around, which follows from the planes of the file by the symmetry that their last angle
/// stands for: 0 all around, 90 four quarters, 180 two halves, 360 none, and 90 to 270 two halves, too. Candela are
/// those of the file times its multiplier and factors. Factors of TILT are passed over with a warning. Memory is in
/// proportion to the file. Throws Error{BadInput}, "FILE:LINE: ...", for what is no such file, for photometry of the
/// types A and B, for angles that do not ascend, numbers that are not finite, and counts beyond the limits.
[[nodiscard]] IesFile readIes(const InputFile &file);

} // namespace hyalite::core
