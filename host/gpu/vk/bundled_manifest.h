// The manifest of the driver that an archive may have beside its program (cmake/lavapipe.sh).
#pragma once

#include <string_view>

namespace hyalite::core::gpu {

/// Its place in the archive, whose programs are in bin.
inline constexpr std::string_view bundledManifest = "lib/hyalite/lavapipe/lvp_icd.json";

} // namespace hyalite::core::gpu
