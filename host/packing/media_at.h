// The glass at a point of a scene: where a camera's paths begin.
#pragma once

#include "host/scene/scene.h"

#include <cstdint>
#include <span>

namespace hyalite {

/// The glass around a point in world space, as shaders/bsdf/media.glsl counts it. `packedMaterial` has the packed index of
/// each material.
///
/// A solid is around the point if its surface winds around it: the solid angle of its triangles, by the side that is seen,
/// is 4 pi, and 0 from outside. Jacobson, Kavan and Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized
/// Winding Numbers", SIGGRAPH 2013. An open sheet of glass, which has no inside, is around nothing.
[[nodiscard]] std::uint32_t mediaAt(const Scene &scene, std::span<const std::uint32_t> packedMaterial,
                                    const glm::dvec3 &point);

} // namespace hyalite
