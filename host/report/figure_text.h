// Figures of a profile as people read them, in tables and in pages.
#pragma once

#include <string>

namespace hyalite::core {

/// Four digits at least, whatever the size: "0.012", "12.3", "1234".
[[nodiscard]] std::string millisText(double millis);

/// A share in [0, 1] in per cent: "12.3 %".
[[nodiscard]] std::string shareText(double share);

} // namespace hyalite::core
