// Lights without size. Twin: shaders/lights/lights.glsl.
#pragma once

#include "host/reference/vector.h"

namespace hyalite::reference {

/// How far light travels that comes from no place.
template <class Real> inline constexpr Real unboundedDistance = Real(3.4028234e38f);

/// How much of a spot's intensity there is in the direction from which it is seen: `toSpot` leads to it. It fades between
/// two angles as the cubic that is even at both ends.
template <class Real>
[[nodiscard]] Real spotFalloff(const Vec3<Real> &toSpot, const Vec3<Real> &axis, Real cosineOuter,
                               Real falloffScale) {
    const Real inside = -dotProduct(toSpot, axis) - cosineOuter;
    const Real t = greater(lesser(inside * falloffScale, Real(1)), Real(0));
    return t * t * (Real(3) - Real(2) * t);
}

} // namespace hyalite::reference
