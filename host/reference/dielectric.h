// Reflection and refraction at smooth glass. Twin: shaders/dielectric.glsl.
#pragma once

#include "host/reference/vector.h"

namespace hyalite::reference {

template <class Real> struct Refraction {
    Vec3<Real> direction; ///< of the transmitted ray, unit length; meaningless when total
    Real reflectance;     ///< share of the light that is reflected, in [0, 1]
    Real transmittance;   ///< the rest
    bool isTotal;         ///< nothing is transmitted
};

/// `direction` meets a surface whose unit normal `facing` lies on the side that it comes from. `index` is that of the
/// glass relative to its surroundings; `isEntering`: the ray comes from the surroundings.
///
/// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994, with the cosine on the optically thinner
/// side, so that the reflectance rises to 1 at the critical angle.
template <class Real>
[[nodiscard]] Refraction<Real> refractRay(const Vec3<Real> &direction, const Vec3<Real> &facing, Real index,
                                          bool isEntering) {
    const Real eta = isEntering ? Real(1) / index : index;
    const Real cosIncident = -dotProduct(direction, facing);
    const Real radicand = Real(1) - eta * eta * (Real(1) - cosIncident * cosIncident);
    const Real cosTransmitted = std::sqrt(greater(radicand, Real(0)));
    const Real along = eta * cosIncident - cosTransmitted;
    const Vec3<Real> transmitted = direction * eta + facing * along;
    const Real ratio = (Real(1) - index) / (Real(1) + index);
    const Real normalReflectance = ratio * ratio;
    const Real k = Real(1) - lesser(isEntering ? cosIncident : cosTransmitted, Real(1));
    const Real k2 = k * k;
    const Real reflectance = normalReflectance + (Real(1) - normalReflectance) * (k2 * k2 * k);
    return {unitVector(transmitted), reflectance, Real(1) - reflectance, radicand < 0};
}

} // namespace hyalite::reference
