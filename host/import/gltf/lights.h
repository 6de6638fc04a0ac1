// Lights of a glTF file (KHR_lights_punctual).
#pragma once

#include "host/import/gltf/document.h"
#include "host/scene/scene.h"

#include <glm/mat4x3.hpp>

#include <optional>

namespace hyalite::core::gltf {

/// The light of a node, where its map to the world brings it; nothing for a node without one. Candela and lux count as
/// watts per steradian and per square metre. A range is passed over with a warning.
[[nodiscard]] std::optional<Light> readLight(const Document &document, const JsonObject &node,
                                             const glm::dmat4x3 &toWorld);

} // namespace hyalite::core::gltf
