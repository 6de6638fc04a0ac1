// GGX directional albedo tables for the kernels.
#pragma once

#include "shaders/layout/layout.h"

#include <bitset>
#include <vector>

namespace hyalite::core {

/// The first layout::energyTexelCount lookup rows of a scene with rough surfaces; shaders/bsdf/energy.glsl reads them.
/// Computed with + - * / and square roots only, so that they are the same on every machine. Takes some hundredths of a
/// second.
[[nodiscard]] std::vector<layout::LookupRow> makeEnergyTexels();

/// The refractive indices of a medium for all waves, in [1, 10].
struct IndexSpan {
    double least;
    double most;
};

/// The part of the table of rough glass that a scene reads.
struct GlassNodes {
    /// By the index, for light from the thinner and the denser side.
    std::bitset<2 * layout::energyIndices> layers;
    std::bitset<layout::energyRoughnesses> roughnesses;

    /// For light from one medium to another; of one wave it has one of the indices of each.
    void addIndices(const IndexSpan &before, const IndexSpan &beyond);
    /// For roughnesses in [least, most], within [0, 1].
    void addRoughness(double least, double most);
};

/// The next layout::glassTexelCount lookup rows of a scene with rough glass: what it reflects and transmits at once, as
/// above. Nodes that are not asked for are 1. Glass of one index and roughness takes milliseconds, with textures of
/// roughness some hundredths of a second.
[[nodiscard]] std::vector<layout::LookupRow> makeGlassTexels(const GlassNodes &nodes);

/// Cosine-weighted average, over the hemisphere, of the Fresnel reflectance of a conductor with the complex refractive
/// index `index` + i `extinction`.
[[nodiscard]] double averageConductorReflectance(double index, double extinction);

} // namespace hyalite::core
