// Reflection and refraction at smooth glass. Twin: shaders/bsdf/dielectric.glsl.
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

template <class Real> struct Interface {
    Vec3<Real> refracted; ///< direction, unit length; meaningless where the reflectance is 1
    Real reflectance;     ///< in [0, 1]; 1: total
};

/// What a smooth interface does with unpolarised light: Fresnel's equations. `direction` meets it from the side of its
/// unit normal `facing`; `eta` is the refractive index on that side divided by the one beyond.
template <class Real>
[[nodiscard]] Interface<Real> meetInterface(const Vec3<Real> &direction, const Vec3<Real> &facing, Real eta) {
    const Real cosIncident = -dotProduct(direction, facing);
    const Real radicand = Real(1) - eta * eta * (Real(1) - cosIncident * cosIncident);
    const Real cosTransmitted = std::sqrt(greater(radicand, Real(0)));
    const Real along = eta * cosIncident - cosTransmitted;
    const Vec3<Real> refracted = direction * eta + facing * along;
    const Real acrossBefore = eta * cosIncident;
    const Real alongBeyond = eta * cosTransmitted;
    const Real across = (acrossBefore - cosTransmitted) / (acrossBefore + cosTransmitted);
    const Real parallel = (cosIncident - alongBeyond) / (cosIncident + alongBeyond);
    const Real reflectance = Real(0.5) * (across * across + parallel * parallel);
    return {unitVector(refracted), radicand > 0 ? lesser(reflectance, Real(1)) : Real(1)};
}

} // namespace hyalite::reference
