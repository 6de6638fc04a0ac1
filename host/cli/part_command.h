// The command line that makes a part of a picture.
#pragma once

#include "host/farm/part_origin.h"

#include <string>

namespace hyalite::core {

/// The command that renders `part` instead of the origin's `own`, into a file that is named alike; quoted for a shell,
/// and clean, as who reads it may run it.
[[nodiscard]] std::string commandFor(const PartOrigin &origin, const Part &own, const Part &part);

} // namespace hyalite::core
