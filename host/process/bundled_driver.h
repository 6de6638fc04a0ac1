// The driver that an archive may have beside its program (cmake/lavapipe.sh), for machines without any.
#pragma once

#include <filesystem>
#include <optional>

namespace hyalite::core {

/// Its manifest, if there is one.
[[nodiscard]] std::optional<std::filesystem::path> bundledDriver();

/// Names it to the Vulkan loader, by environment variables, if the system has no driver's manifest and none is named, or if
/// HYALITE_BUNDLED_DRIVER is 1; not if that is 0. Call it before a driver is loaded, while no other thread reads the
/// environment. Throws Error{Usage} for another value, and Error{NoDevice} for 1 without a driver.
void offerBundledDriver();

} // namespace hyalite::core
