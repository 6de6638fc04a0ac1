// Version of this interface, and what its symbols are marked with.
#pragma once

// Semantic (semver.org): programs that were written for MAJOR.MINOR compile and run with a later minor version.
#define HYALITE_API_MAJOR 1
#define HYALITE_API_MINOR 0
#define HYALITE_API_PATCH 0

#define HYALITE_API __attribute__((visibility("default")))

namespace hyalite {

/// The version of the renderer, which grows with each change of a picture, such as "0.1.0".
[[nodiscard]] HYALITE_API const char *version() noexcept;

} // namespace hyalite
