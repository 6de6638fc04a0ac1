// Materials of MTL files: what the statements of programs mean together.
#pragma once

#include "host/scene/material.h"

#include <optional>
#include <string>

namespace hyalite::core {

/// The values of the statements of one material; empty: left out.
struct MtlStatements {
    std::string name;
    std::optional<glm::vec3> diffuse;
    glm::vec3 specular{0.0f};
    glm::vec3 emission{0.0f};
    std::optional<float> exponent;
    std::optional<float> roughness;
    std::optional<float> metallic;
    float clearcoat = 0.0f;
    std::optional<float> clearcoatRoughness;
    std::optional<float> dissolve;
    std::optional<float> transparency;
    std::optional<float> index;
    int illumination = 2;
    TextureSlots textures{};
    float normalStrength = 1.0f;
    std::string colourName;  ///< of map_Kd
    std::string ambientName; ///< of map_Ka
    bool isCutOut = false;   ///< map_Kd has transparent places
};

/// `d` counts before `Tr`, which some programs write with the meaning of d beside it. Alone, a Tr of 1 is opaque, too:
/// it is what programs write that take Tr for d, and whoever wants nothing to be seen writes no mesh. In [0, 1].
[[nodiscard]] float opacityOf(const MtlStatements &mtl);

/// Programs write `illum` as they like, for instance 4 or 7 for all that they have. It makes a metal or glass of what
/// has no look of its own: no colour, no texture, and nothing of the physical statements.
[[nodiscard]] Material materialOf(const MtlStatements &mtl);

} // namespace hyalite::core
