// GGX directional albedo tables for the kernels.
#pragma once

#include "shaders/layout/layout.h"

#include <vector>

namespace hyalite {

/// The first layout::energyTexelCount texels of a scene with rough surfaces; shaders/bsdf/energy.glsl reads them.
/// Computed from + - * / and square roots alone, so that it is the same on every machine. Takes some hundredths of a
/// second.
[[nodiscard]] std::vector<layout::LookupRow> makeEnergyTexels();

/// The average over the hemisphere, weighted by the cosine, of what a metal of the complex refractive index
/// `index` + i `extinction` reflects by Fresnel's equations.
[[nodiscard]] double averageConductorReflectance(double index, double extinction);

} // namespace hyalite
