// The glass at a point of a scene: where a camera's paths begin.
#pragma once

#include "host/scene/scene.h"

#include <cstdint>
#include <span>

namespace hyalite::core {

struct MediaAt {
    std::uint32_t around = 0;
    /// Boxes around glass reach into that of the origins: they may lie on both sides.
    bool isSurfaceNear = false;
};

/// The glass around a point in world space, as shaders/bsdf/media.glsl counts it. `packedMaterial` has the packed index
/// of each material.
///
/// `spread` is half the size of the box around the point in which primary rays begin.
///
/// A solid is around the point if its surface winds around it: the solid angle of its triangles, by the side that is
/// seen, is 4 pi, and 0 from outside. Jacobson, Kavan and Sorkine-Hornung, "Robust Inside-Outside Segmentation using
/// Generalized Winding Numbers", SIGGRAPH 2013. An open sheet of glass, which has no inside, is around nothing.
[[nodiscard]] MediaAt mediaAt(const Scene &scene, std::span<const std::uint32_t> packedMaterial,
                              const glm::dvec3 &point, const glm::dvec3 &spread);

} // namespace hyalite::core
