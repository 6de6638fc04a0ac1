// Directions and points drawn from two numbers in [0, 1), and the densities that they have. Twin: shaders/math/sampling.glsl.
#pragma once

#include "host/reference/functions.h"

namespace hyalite::reference {

template <class Real> inline constexpr Real inversePi = Real(0.31830988618379067);

/// Two unit vectors that make a right-handed frame with the unit vector `n`: Duff et al., "Building an Orthonormal
/// Basis, Revisited", JCGT 6(1), 2017.
template <class Real> struct Frame {
    Vec3<Real> x;
    Vec3<Real> y;
    Vec3<Real> z;
};

template <class Real> [[nodiscard]] Frame<Real> frameAround(const Vec3<Real> &n) {
    const Real side = n.z < 0 ? Real(-1) : Real(1);
    const Real a = Real(-1) / (side + n.z);
    const Real b = n.x * n.y * a;
    const Real xx = Real(1) + side * (n.x * n.x * a);
    const Real yy = side + n.y * n.y * a;
    return {{xx, side * b, -side * n.x}, {b, yy, -n.y}, n};
}

template <class Real> [[nodiscard]] Vec3<Real> toWorld(const Frame<Real> &f, const Vec3<Real> &v) {
    return f.x * v.x + f.y * v.y + f.z * v.z;
}

/// Around `normal` with the density cos / pi per solid angle: a point of the unit disc, projected up (Malley).
template <class Real> [[nodiscard]] Vec3<Real> sampleCosine(const Vec3<Real> &normal, const Vec2<Real> &u) {
    const Real radius = std::sqrt(u.x);
    const SineCosine<Real> angle = sineCosine(u.y);
    const Real below = Real(1) - u.x;
    const Vec3<Real> local(radius * angle.cosine, radius * angle.sine, std::sqrt(below));
    return unitVector(toWorld(frameAround(normal), local));
}

template <class Real> [[nodiscard]] Real pdfCosine(Real cosine) { return cosine * inversePi<Real>; }

/// Weights of a triangle's first and second vertex, uniform over its area: PBRT, section 6.5.4, before it was made one
/// with less distortion.
template <class Real> [[nodiscard]] Vec2<Real> sampleTriangle(const Vec2<Real> &u) {
    const Real root = std::sqrt(u.x);
    return {Real(1) - root, u.y * root};
}

/// The cone of directions from a point that meet a sphere, `squaredDistance` from the point to its centre, more than
/// the squared radius: 1 - cos of the half angle, written so that it does not cancel for small cones.
template <class Real> [[nodiscard]] Real coneHeight(Real squaredRadius, Real squaredDistance) {
    const Real squaredSine = squaredRadius / squaredDistance;
    const Real squaredCosine = Real(1) - squaredSine;
    return squaredSine / (Real(1) + std::sqrt(greater(squaredCosine, Real(0))));
}

/// Uniform over the solid angle of the cone around `axis` with this height.
template <class Real>
[[nodiscard]] Vec3<Real> sampleCone(const Vec3<Real> &axis, Real height, const Vec2<Real> &u) {
    const Real below = u.x * height;
    const Real cosine = Real(1) - below;
    const Real sine = std::sqrt(below * (Real(1) + cosine));
    const SineCosine<Real> angle = sineCosine(u.y);
    const Vec3<Real> local(sine * angle.cosine, sine * angle.sine, cosine);
    return unitVector(toWorld(frameAround(axis), local));
}

template <class Real> [[nodiscard]] Real pdfCone(Real height) { return Real(0.5) * inversePi<Real> / height; }

/// On the unit sphere, uniform over its area.
template <class Real> [[nodiscard]] Vec3<Real> sampleSphere(const Vec2<Real> &u) {
    const Real z = Real(1) - Real(2) * u.x;
    const Real radius = std::sqrt(greater(Real(1) - z * z, Real(0)));
    const SineCosine<Real> angle = sineCosine(u.y);
    return unitVector(Vec3<Real>(radius * angle.cosine, radius * angle.sine, z));
}

/// The share of a sample drawn with density `a` where another way of sampling has density `b`: Veach's power heuristic
/// with exponent 2, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995, by the quotient
/// of the smaller to the larger, as squares may leave the range of floats.
template <class Real> [[nodiscard]] Real powerHeuristic(Real a, Real b) {
    const Real quotient = lesser(a, b) / greater(a, b);
    const Real squared = quotient * quotient;
    const Real larger = Real(1) / (Real(1) + squared);
    return a < b ? squared * larger : larger;
}

} // namespace hyalite::reference
