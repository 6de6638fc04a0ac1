// Rough surfaces of microfacets with the GGX distribution. Twin: shaders/bsdf/microfacet.glsl.
//
// All directions are unit vectors in the frame of the surface, whose normal is +z; `view` has z > 0 and leads back to
// where the path comes from. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; Heitz,
// "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014, for the masking of both
// directions together: G = 2 |o.z| |i.z| / (|o.z| stretch(i) + |i.z| stretch(o)).
#pragma once

#include "host/reference/sampling.h"

namespace hyalite::reference {

/// How long `w` is seen from the stretched surface. `alpha` in (0, 1].
template <class Real> [[nodiscard]] Real stretchOf(const Vec3<Real> &w, Real alpha) {
    const Real squaredAlpha = alpha * alpha;
    const Real squaredSine = w.x * w.x + w.y * w.y;
    return std::sqrt(squaredAlpha * squaredSine + w.z * w.z);
}

/// Microfacets with the normal `m`, per solid angle and unit of area.
template <class Real> [[nodiscard]] Real facetDensity(const Vec3<Real> &m, Real alpha) {
    const Real squaredAlpha = alpha * alpha;
    const Real squaredSine = m.x * m.x + m.y * m.y;
    const Real spread = squaredSine + squaredAlpha * (m.z * m.z);
    return squaredAlpha * inversePi<Real> / (spread * spread);
}

/// A facet's normal with the density facetDensity G1 (view.m) / view.z of those that are seen: Dupuy and Benyoub,
/// "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
template <class Real>
[[nodiscard]] Vec3<Real> sampleVisibleFacet(const Vec3<Real> &view, Real alpha, const Vec2<Real> &u) {
    const Vec3<Real> stretched = unitVector(Vec3<Real>(view.x * alpha, view.y * alpha, view.z));
    const Real z = (Real(1) - u.y) * (Real(1) + stretched.z) - stretched.z;
    const Real sine = std::sqrt(greater(Real(1) - z * z, Real(0)));
    const SineCosine<Real> angle = sineCosine(u.x);
    const Vec3<Real> cap = Vec3<Real>(sine * angle.cosine, sine * angle.sine, z) + stretched;
    return unitVector(Vec3<Real>(cap.x * alpha, cap.y * alpha, cap.z));
}

/// The density, per solid angle, of the direction that a visible facet reflects `view` to; `density` is that of the
/// facets.
template <class Real>
[[nodiscard]] Real reflectionDensity(Real density, const Vec3<Real> &view, Real stretchView) {
    return density / (Real(2) * (view.z + stretchView));
}

/// How many of the facets that are seen are also lit: G / G1(view). `light` may be on the other side.
template <class Real>
[[nodiscard]] Real litShare(Real viewHeight, Real stretchView, Real lightHeight, Real stretchLight) {
    const Real height = std::abs(lightHeight);
    return height * (viewHeight + stretchView) / (viewHeight * stretchLight + height * stretchView);
}

/// The facet that reflects `view` to `light`.
template <class Real> [[nodiscard]] Vec3<Real> facetBetween(const Vec3<Real> &view, const Vec3<Real> &light) {
    return unitVector(view + light);
}

/// The facet that refracts `view` to `light`, on the other side, with z > 0 where there is one; `eta` is the refractive
/// index on the side of `view` divided by the other.
template <class Real>
[[nodiscard]] Vec3<Real> facetAcross(const Vec3<Real> &view, const Vec3<Real> &light, Real eta) {
    const Vec3<Real> m = unitVector(view * eta + light);
    return m.z < 0 ? -m : m;
}

/// The density, per solid angle, of the direction to which visible facets refract: that of the facets that are seen, by
/// Walter's Jacobian (equation 17). `viewCosine` > 0 and `lightCosine` < 0 are those to the facet.
template <class Real>
[[nodiscard]] Real refractionDensity(Real density, const Vec3<Real> &view, Real stretchView, Real viewCosine,
                                     Real lightCosine, Real eta) {
    const Real seen = density * Real(2) * viewCosine * -lightCosine;
    const Real sum = eta * viewCosine + lightCosine;
    return seen / ((view.z + stretchView) * (sum * sum));
}

} // namespace hyalite::reference
