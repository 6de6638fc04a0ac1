// Diagnosis: why a picture is black or not a number, in words for warnings.
#pragma once

#include "host/engine/prepare.h"
#include "host/film/film.h"
#include "host/film/ray_counts.h"

#include <optional>
#include <string>

namespace hyalite::core {

/// More than 1 % of the pixels are not finite, or all are black, or nothing is in view. For a black picture a few
/// primary rays and shadow rays of the reference renderer find the most likely reason. Empty where all is well.
[[nodiscard]] std::optional<std::string> diagnosePicture(const PreparedScene &scene, const Film &film,
                                                         const RayCounts &rays);

/// After a picture of light that is shown with `exposureStops`: it is white nearly everywhere, and the exposure that
/// shows it.
[[nodiscard]] std::optional<std::string> diagnoseExposure(const Film &film, double exposureStops);

} // namespace hyalite::core
