// Projections: cameras as matrices, for programs that read pictures.
#pragma once

#include "host/image/picture.h"
#include "host/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace hyalite::core {

/// The projection of the scene's camera, in the coordinates of the scene's file; of a lens that of its centre. None of
/// a panorama, which no matrix describes.
///
/// The z of NDC, which has no meaning there, makes the matrix invertible: 1 - 1/z of a perspective camera, whose depth
/// is z, and z of an orthographic one.
[[nodiscard]] std::optional<Projection> projectionOf(const Scene &scene);

/// The place of a point of the scene in the camera's picture, in pixels from the top left; of a lens that of its centre.
/// None behind a perspective camera.
[[nodiscard]] std::optional<glm::dvec2> pixelOf(const Camera &camera, const glm::dvec3 &point);

} // namespace hyalite::core
