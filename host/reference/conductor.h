// What metals reflect. Twin: shaders/bsdf/conductor.glsl.
#pragma once

#include "host/reference/vector.h"

namespace hyalite::reference {

/// Fresnel's equations for unpolarised light at a surface from vacuum to the complex refractive index n + i k: Lagarde,
/// "Memo on Fresnel equations", 2013. `cosine` in [0, 1].
template <class Real> [[nodiscard]] Real conductorReflectance(Real cosine, Real index, Real extinction) {
    const Real squaredCosine = cosine * cosine;
    const Real squaredSine = Real(1) - squaredCosine;
    const Real squaredIndex = index * index;
    const Real squaredExtinction = extinction * extinction;
    const Real difference = squaredIndex - squaredExtinction - squaredSine;
    const Real length = std::sqrt(difference * difference + Real(4) * squaredIndex * squaredExtinction);
    const Real a = std::sqrt(greater(Real(0.5) * (length + difference), Real(0)));
    const Real sum = length + squaredCosine;
    const Real twice = Real(2) * cosine * a;
    const Real otherSum = squaredCosine * length + squaredSine * squaredSine;
    const Real otherTwice = twice * squaredSine;
    const Real across = (sum - twice) / (sum + twice);
    const Real along = (otherSum - otherTwice) / (otherSum + otherTwice);
    return lesser(Real(0.5) * across * (Real(1) + along), Real(1));
}

template <class Real>
[[nodiscard]] Vec3<Real> conductorReflectance(Real cosine, const Vec3<Real> &index,
                                              const Vec3<Real> &extinction) {
    return {conductorReflectance(cosine, index.x, extinction.x),
            conductorReflectance(cosine, index.y, extinction.y),
            conductorReflectance(cosine, index.z, extinction.z)};
}

/// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994: from `normal` seen head on to 1.
template <class Real> [[nodiscard]] Vec3<Real> schlickReflectance(Real cosine, const Vec3<Real> &normal) {
    const Real k = Real(1) - lesser(cosine, Real(1));
    const Real k2 = k * k;
    const Real grazing = k2 * k2 * k;
    return normal + (Real(1) - normal) * grazing;
}

} // namespace hyalite::reference
