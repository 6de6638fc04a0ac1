// Ray-sphere intersection. Twin: shaders/geometry/sphere.glsl.
#pragma once

#include "host/reference/vector.h"

namespace hyalite::reference {

/// The smallest positive distance at which a ray meets a sphere, or a negative number. `direction` is of unit length.
///
/// Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
/// chapter 7: the discriminant comes from the vector between the centre and its nearest point on the ray, and the
/// roots from c/q and q, so that neither cancels for small or for giant spheres.
///
/// A ray that starts on the sphere has one root that is 0 by definition, and the other is -2 f.d: it cannot find its
/// own starting point again, whatever the rounding, and no offset is needed.
template <class Real>
[[nodiscard]] Real intersectSphere(const Vec3<Real> &origin, const Vec3<Real> &direction,
                                   const Vec3<Real> &centre, Real radius, bool startsOnSphere) {
    const Vec3<Real> f = origin - centre;
    const Real b = dotProduct(f, direction);
    const Vec3<Real> nearest = f - direction * b;
    const Real squaredRadius = radius * radius;
    const Real discriminant = squaredRadius - dotProduct(nearest, nearest);
    const Real c = dotProduct(f, f) - squaredRadius;
    const Real root = std::sqrt(greater(discriminant, Real(0)));
    const Real q = b >= 0 ? -b - root : root - b;
    const Real r = c / q;
    const Real chord = Real(-2) * b;
    const Real first = r < q ? r : q;
    const Real second = r < q ? q : r;
    // Along the tangent the sign of a chord is that of rounding.
    const Real across = chord > radius * (Real(8) * roundingUnit<Real>) ? chord : Real(-1);
    const Real distance = startsOnSphere ? across : (first > 0 ? first : second);
    return startsOnSphere || discriminant > 0 ? distance : Real(-1);
}

} // namespace hyalite::reference
