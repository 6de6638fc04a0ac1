// Shading counts: what a render does beside following rays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hyalite::core {

/// A part of a material that sends a path on.
enum class Lobe {
    Diffuse,             ///< Lambert's, also below plastic
    DiffuseTransmission, ///< the same, on the other side
    Glossy,              ///< facets of metal, plastic and lacquer
    Sheen,
    Thin,       ///< facets that let light through thin glass
    RoughGlass, ///< facets that reflect or refract it
    Mirror,     ///< smooth metal
    ClearGlass, ///< smooth glass
};
inline constexpr std::array<const char *, 8> lobeNames{
    "diffuse", "diffuseTransmission", "glossy", "sheen", "thin", "roughGlass", "mirror", "clearGlass"};

struct ShadingCounts {
    std::array<std::uint64_t, lobeNames.size()> lobes{}; ///< surfaces that were shaded, by Lobe
    std::uint64_t lightSamples = 0;                      ///< lights that were looked at, visible or not
    std::uint64_t lightNodesRead = 0; ///< of the light tree, to choose and to weigh choices
    std::uint64_t textureReads = 0;   ///< texels, and the descriptions of their textures
    std::uint64_t filmSamples = 0;    ///< added to the film

    ShadingCounts &operator+=(const ShadingCounts &other) {
        for (std::size_t lobe = 0; lobe < lobes.size(); ++lobe)
            lobes[lobe] += other.lobes[lobe];
        lightSamples += other.lightSamples;
        lightNodesRead += other.lightNodesRead;
        textureReads += other.textureReads;
        filmSamples += other.filmSamples;
        return *this;
    }
    bool operator==(const ShadingCounts &) const = default;
};

} // namespace hyalite::core
