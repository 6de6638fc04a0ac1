// Primary rays. Twin: shaders/camera.glsl.
#pragma once

#include "host/reference/vector.h"
#include "shaders/layout.h"

namespace hyalite::reference {

/// The unit direction of the primary ray through `offset` in [0,1)^2 inside of `pixel`; see FrameRecord.
template <class Real>
[[nodiscard]] Vec3<Real> primaryDirection(const layout::FrameRecord &frame, const glm::uvec2 &pixel,
                                          const Vec2<Real> &offset) {
    const Real x = static_cast<Real>(pixel.x) + offset.x - Real(0.5) * static_cast<Real>(frame.imageWidth);
    const Real y = Real(0.5) * static_cast<Real>(frame.imageHeight) - (static_cast<Real>(pixel.y) + offset.y);
    const Vec3<Real> direction =
        Vec3<Real>(frame.pixelRight) * x + Vec3<Real>(frame.pixelUp) * y + Vec3<Real>(frame.imagePlane);
    return unitVector(direction);
}

} // namespace hyalite::reference
