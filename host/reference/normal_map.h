// Normals turned by images. Twin: shaders/textures/normal_map.glsl.
#pragma once

#include "host/reference/texture.h"

namespace hyalite::reference {

/// The directions on a surface in which u and v grow, of any length; 0 where they are not known.
template <class Real> struct Tangent {
    Vec3<Real> alongU{Real(0)};
    Vec3<Real> alongV{Real(0)};
};

template <class Real>
inline constexpr Real leastSpan = Real(1e-30f); ///< of a triangle, and of its texture coordinates
template <class Real>
inline constexpr Real mostSpan = Real(1e30f); ///< of coordinates: the inverse is no subnormal number
template <class Real>
inline constexpr Real
    leastDeterminant = Real(1e-20f); ///< of coordinates that lie on one line, up to rounding
template <class Real>
inline constexpr Real
    leastHeight = Real(0.01f); ///< of a mapped normal above the surface, and of what it reflects

/// Coordinates and edges are scaled first, as their products leave the range of floats.
template <class Real>
[[nodiscard]] Tangent<Real> triangleTangent(const layout::TriangleRecord &triangle,
                                            const Coordinates<Real> &at) {
    const Vec3<Real> v0(triangle.v0);
    const Vec3<Real> edge1 = Vec3<Real>(triangle.v1) - v0;
    const Vec3<Real> edge2 = Vec3<Real>(triangle.v2) - v0;
    const Vec2<Real> step1 = at.uv1 - at.uv0;
    const Vec2<Real> step2 = at.uv2 - at.uv0;
    const Real size = largestComponent(greater(absolute(edge1), absolute(edge2)));
    const Real span =
        greater(greater(std::abs(step1.x), std::abs(step1.y)), greater(std::abs(step2.x), std::abs(step2.y)));
    if (!(size > leastSpan<Real> && span > leastSpan<Real> && span < mostSpan<Real>))
        return {};
    const Vec3<Real> a = edge1 * (Real(1) / size);
    const Vec3<Real> b = edge2 * (Real(1) / size);
    const Vec2<Real> s = step1 * (Real(1) / span);
    const Vec2<Real> t = step2 * (Real(1) / span);
    const Real determinant = s.x * t.y - t.x * s.y;
    if (!(std::abs(determinant) > leastDeterminant<Real>))
        return {};
    const Vec3<Real> alongU = a * t.y - b * s.y;
    const Vec3<Real> alongV = b * s.x - a * t.x;
    return determinant > 0 ? Tangent<Real>{alongU, alongV} : Tangent<Real>{-alongU, -alongV};
}

/// Of the point of a sphere whose outward normal is `outward`.
template <class Real> [[nodiscard]] Tangent<Real> sphereTangent(const Vec3<Real> &outward) {
    const Vec3<Real> alongU(outward.z, Real(0), -outward.x);
    return {alongU, crossProduct(outward, alongU)};
}

/// The unit normal that the normal map in a TextureRecord's row makes of `normal`, which it stays where no tangent is
/// known.
template <class Real>
[[nodiscard]] Vec3<Real> mappedNormal(const std::vector<layout::TextureRow> &rows, const Vec3<Real> &normal,
                                      const Tangent<Real> &tangent, std::uint32_t row, const Vec2<Real> &uv) {
    const Vec3<Real> flatU = tangent.alongU - normal * dotProduct(normal, tangent.alongU);
    if (!(dotProduct(flatU, flatU) > leastSpan<Real>))
        return normal;
    const Vec3<Real> x = unitVector(flatU);
    const Vec3<Real> left = crossProduct(normal, x);
    const Vec3<Real> y = dotProduct(left, tangent.alongV) < 0 ? -left : left;
    const Real strength = static_cast<Real>(std::bit_cast<float>(rows[row].w));
    const Vec3<Real> turned = Real(2) * lookUpTexture(rows, row, uv) - Real(1);
    const Vec2<Real> sideways = Vec2<Real>(turned) * strength;
    return unitVector<Real>(x * sideways.x + y * sideways.y + normal * greater(turned.z, leastHeight<Real>));
}

/// The unit normal nearest to `normal`, nearly, that faces a ray in `direction` and does not mirror it into the
/// surface: a mapped normal knows nothing of either. Keller et al., "The Iray Light Transport Simulation and Rendering
/// System", 2017, section A.3.
template <class Real>
[[nodiscard]] Vec3<Real> visibleNormal(const Vec3<Real> &direction, const Vec3<Real> &normal,
                                       const Vec3<Real> &geometricNormal) {
    const bool isBehind = dotProduct(direction, geometricNormal) > 0;
    Vec3<Real> facing = isBehind ? -normal : normal;
    const Vec3<Real> up = isBehind ? -geometricNormal : geometricNormal;
    const Real lack = leastHeight<Real> + dotProduct(direction, facing);
    if (lack > 0)
        facing = unitVector<Real>(facing - direction * lack);
    const Vec3<Real> mirrored = mirrorDirection(direction, facing);
    const Real depth = leastHeight<Real> - dotProduct(mirrored, up);
    if (depth > 0) {
        const Vec3<Real> grazing = unitVector<Real>(mirrored + up * depth);
        facing = unitVector<Real>(grazing - direction);
    }
    return isBehind ? -facing : facing;
}

} // namespace hyalite::reference
