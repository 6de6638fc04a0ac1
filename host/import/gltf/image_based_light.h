// Light from all around in a glTF file (EXT_lights_image_based).
#pragma once

#include "host/image/image.h"
#include "host/import/file_access.h"
#include "host/import/gltf/buffers.h"

#include <optional>

namespace hyalite::core::gltf {

/// The image-based light of a scene as an environment, times its intensity and turned by its rotation: radiance >= 0 by
/// longitude and latitude, as Environment has it. Nothing for a scene without one, and, with a warning, for one whose
/// images cannot be read. The first cube map alone is read: the blurred ones and the coefficients of irradiance say what
/// the renderer computes of it. Throws Error{BadInput} for a malformed document.
[[nodiscard]] std::optional<Image> readImageBasedLight(Buffers &buffers, const FileAccess &access,
                                                       const JsonObject &scene);

} // namespace hyalite::core::gltf
