// Diagnosis: why a picture is, or will be, black or not a number, in words for warnings.
#pragma once

#include "host/film/film.h"
#include "host/render/prepare.h"

#include <optional>
#include <string>

namespace hyalite {

/// Before the render: what of the scene's light its integrator does not see, or that there is none at all. Empty where
/// all is well, and for integrators that show something else than light.
[[nodiscard]] std::optional<std::string> diagnoseLight(const Scene &scene);

/// After the render: more than 1 % of the pixels are not finite, or all are black, or nothing is in view. For a black one a few primary rays
/// and shadow rays of the reference renderer find the most likely reason. Empty where all is well.
[[nodiscard]] std::optional<std::string> diagnosePicture(const PreparedScene &scene, const Film &film,
                                                         const RayCounts &rays);

} // namespace hyalite
