// Sheen directional albedo table for the kernels.
#pragma once

#include "shaders/layout/layout.h"

#include <vector>

namespace hyalite::core {

/// The directional albedo of white sheen (shaders/bsdf/sheen.glsl) by the cosine of the viewer and the roughness, whose
/// nodes are evenly spaced in the square root of the cosine and in the roughness: layout::sheenTexelCount rows.
/// Computed with + - * / and square roots only, so that it is the same on every machine. Takes some hundredths of a
/// second.
[[nodiscard]] std::vector<layout::LookupRow> makeSheenTexels();

} // namespace hyalite::core
