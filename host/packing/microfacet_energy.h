// GGX directional albedo tables for the kernels.
#pragma once

#include "shaders/layout/layout.h"

#include <vector>

namespace hyalite {

/// The first layout::energyTexelCount lookup rows of a scene with rough surfaces; shaders/bsdf/energy.glsl reads them.
/// Computed with + - * / and square roots only, so that they are the same on every machine. Takes some hundredths of a
/// second.
[[nodiscard]] std::vector<layout::LookupRow> makeEnergyTexels();

/// Cosine-weighted average, over the hemisphere, of the Fresnel reflectance of a conductor with the complex refractive
/// index `index` + i `extinction`.
[[nodiscard]] double averageConductorReflectance(double index, double extinction);

} // namespace hyalite
