// How much light microfacets reflect at once, and what becomes of the rest. Twin: shaders/bsdf/energy.glsl.
//
// Light that one facet sends to another is lost to the model of single reflections; at roughness 1 that is up to half of
// it. Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 courses, give it back as a
// second, diffuse lobe, (1 - E(o)) (1 - E(i)) / (pi (1 - average E)), which is reciprocal and keeps energy exactly as
// long as E is that of the table: it is linear in between, and so are the averages of it.
#pragma once

#include "host/reference/vector.h"
#include "shaders/layout/layout.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace hyalite::reference {

template <class Real> struct Energy {
    Real white; ///< reflected at once by facets that reflect everything
    Real
        grazing; ///< and of that the share (1 - cos)^5, summed: by F0 between 0 and 1, Schlick's facets reflect the mixture
};

template <class Real> struct EnergyPlace {
    std::uint32_t cell;
    Real share; ///< of the cell's end
};

/// `position` in [0, 1].
template <class Real> [[nodiscard]] EnergyPlace<Real> energyPlace(Real position, std::uint32_t nodeCount) {
    const Real last = static_cast<Real>(nodeCount - 1);
    const Real inside = greater(lesser(position * last, last), Real(0));
    const std::uint32_t cell = std::min(static_cast<std::uint32_t>(inside), nodeCount - 2);
    return {cell, inside - static_cast<Real>(cell)};
}

template <class Real> [[nodiscard]] Real mixture(Real a, Real b, Real share) { return a + (b - a) * share; }

/// Of a direction with the cosine `cosine` > 0 to the normal, at the roughness sqrt(alpha). Nodes are even in the square
/// roots of both. `texels` begin with the table.
template <class Real>
[[nodiscard]] Energy<Real> energyOf(const std::vector<layout::TexelRecord> &texels, Real cosine,
                                    Real roughness) {
    const EnergyPlace<Real> across = energyPlace(std::sqrt(cosine), layout::energyCosines);
    const EnergyPlace<Real> along = energyPlace(roughness, layout::energyRoughnesses);
    const std::uint32_t row = 2 * (along.cell * (layout::energyCosines - 1) + across.cell);
    const auto inCell = [&](const layout::TexelRecord &ends) {
        const Vec3<Real> value(ends.value);
        const Real last = static_cast<Real>(std::bit_cast<float>(ends.word));
        return mixture(mixture(value.x, value.y, across.share), mixture(value.z, last, across.share),
                       along.share);
    };
    return {inCell(texels[row]), inCell(texels[row + 1])};
}

/// Averages over the hemisphere, weighted by the cosine.
template <class Real>
[[nodiscard]] Energy<Real> averageEnergy(const std::vector<layout::TexelRecord> &texels, Real roughness) {
    const EnergyPlace<Real> along = energyPlace(roughness, layout::energyRoughnesses);
    const layout::TexelRecord &ends = texels[2 * layout::energyCellCount + along.cell];
    const Vec3<Real> value(ends.value);
    const Real last = static_cast<Real>(std::bit_cast<float>(ends.word));
    return {mixture(value.x, value.y, along.share), mixture(value.z, last, along.share)};
}

/// Of facets that reflect `normal` head on.
template <class Real> [[nodiscard]] Real energyAt(const Energy<Real> &energy, Real normal) {
    return mixture(energy.grazing, energy.white, normal);
}

/// What is reflected twice and more often by facets whose reflectance is `average`, of what is not reflected at once;
/// `white` is the average energy. Hill, "A Multi-Faceted Exploration", 2018, part 3.
template <class Real> [[nodiscard]] Vec3<Real> lateReflectance(const Vec3<Real> &average, Real white) {
    const Vec3<Real> above = average * average * white;
    const Vec3<Real> below = Real(1) - average * (Real(1) - white);
    return above * (Real(1) / below);
}

} // namespace hyalite::reference
