// Planes of layers of light: which ones a film keeps, and their names.
#pragma once

#include "host/packing/packed_scene.h"

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Those of classes come first, in the order of layout::light...
struct LightPlanes {
    std::uint32_t classes = 0; ///< bits 1 << layout::light...
    std::uint32_t groups = 0;  ///< how many groups of emitters have one

    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(std::popcount(classes)) + groups;
    }
};

/// What the settings ask for: of classes those that the scene can have.
[[nodiscard]] LightPlanes lightPlanesOf(const PackedScene &scene, const RenderSettings &settings);

/// Names of the layers: "diffuse_direct"; "light_" and the name of a group.
[[nodiscard]] std::vector<std::string> lightPlaneNames(const PackedScene &scene,
                                                       const RenderSettings &settings);

/// Whether it may be the name of a layer of light.
[[nodiscard]] bool isLightPlaneName(std::string_view name);

/// Of the groups' names and of what is in them.
[[nodiscard]] std::uint64_t lightGroupsHash(const PackedScene &scene);

} // namespace hyalite::core
