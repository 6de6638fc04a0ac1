// Materials of a glTF file (glTF 2.0, section 3.9, and the extensions KHR_materials_...).
#pragma once

#include "host/import/gltf/textures.h"
#include "host/scene/material.h"

#include <cstdint>
#include <vector>

namespace hyalite::core::gltf {

struct Materials {
    std::vector<Material>
        list; ///< those of the file in its order, and the default one for primitives that name none
    /// Index of what a primitive of each one shows: another one where too many volumes of glass are told apart, and two
    /// are alike.
    std::vector<std::uint32_t> shownAs;
};

/// Factors out of range are clamped, with a warning.
[[nodiscard]] Materials readMaterials(const Document &document, TextureReader &textures);

} // namespace hyalite::core::gltf
