// Materials of a glTF file (glTF 2.0, section 3.9, and the extensions KHR_materials_...).
#pragma once

#include "host/import/gltf/textures.h"
#include "host/scene/material.h"

#include <vector>

namespace hyalite::core::gltf {

/// The materials of the file in its order, and the default one for primitives that name none. Factors out of range are
/// clamped, with a warning.
[[nodiscard]] std::vector<Material> readMaterials(const Document &document, TextureReader &textures);

} // namespace hyalite::core::gltf
