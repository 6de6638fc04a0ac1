// A ray and a triangle in long double: how far from any doubt is their intersection?
//
// The ray and the vertices are floats, exactly as both programs read them. Seen along the ray, the ray is a point and
// the triangle has corners p0, p1, p2 around it; it is hit where the three edge functions cross(p[i], p[i+1]) have one
// sign. What a program in float32 decides is certain where each of them is larger than its rounding error there.
#pragma once

#include "host/scene/scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hyalite::core::testing {

using Real = long double;
using Vector = glm::vec<3, Real>;
using Corners = std::array<glm::vec3, 3>;

inline constexpr Real roundingUnit = Real(std::numeric_limits<float>::epsilon()) / 2;

/// What rounding leaves a program to decide.
struct Doubt {
    Real inside = 0; ///< least edge function in units of its error: above 1 hit, below -1 missed, for certain
    Real tError = 0; ///< how far its distance may be off
};

struct ExactIntersection {
    Real t = 0;      ///< where the ray meets the plane, or the part of it that is nearest to the triangle
    Real cosine = 0; ///< between the ray and the normal
    Real slenderness = 0; ///< square of the longest edge over twice the area: 1.15 where all edges are equal
    Real reach = 0;       ///< distance from the ray's origin to the farthest vertex
    Real longest = 0;     ///< edge
    Vector normal{0};     ///< unit length, or zero
    Vector position{0};   ///< at t
    Real ourPositionError = 0; ///< of the point that our weights of the vertices give
    Doubt ours;
    Doubt theirs;

    [[nodiscard]] bool isCertain(const Doubt &doubt) const { return doubt.inside > 1 && t > doubt.tError; }
    [[nodiscard]] bool isPossible(const Doubt &doubt) const {
        return doubt.inside >= -1 && t >= -doubt.tError;
    }
    [[nodiscard]] bool isGrazing() const { return cosine < Real(1e-3); }
};

inline Corners cornersOf(const TriangleMesh &mesh, std::uint32_t triangle) {
    const glm::uvec3 &corners = mesh.triangles[triangle].positions;
    return {mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]};
}

/// `direction` is of unit length, except for rounding.
inline ExactIntersection intersectExactly(const Corners &corners, const glm::vec3 &origin,
                                          const glm::vec3 &direction) {
    const Vector d(direction);
    std::array<Vector, 3> toCorner;
    std::array<Vector, 3> image;
    std::array<Real, 3> along;
    ExactIntersection intersection;
    for (std::size_t i = 0; i < 3; ++i) {
        toCorner[i] = Vector(corners[i]) - Vector(origin);
        along[i] = glm::dot(toCorner[i], d) / glm::dot(d, d);
        image[i] = toCorner[i] - d * along[i];
        intersection.reach = std::max(intersection.reach, glm::length(toCorner[i]));
    }
    // Ours (host/reference/box.h): an image moves by 6 units of rounding of the reach, twice that where it is sheared
    // instead of projected; then two products are rounded. Embree's: Pluecker coordinates, where both the edge and
    // the sum of its ends, as they are in space, are multiplied and rounded.
    const Real moved = 12 * roundingUnit * intersection.reach;
    std::array<Real, 3> side;
    std::array<Real, 3> ourError;
    std::array<Real, 3> theirError;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        const Real from = glm::length(image[i]);
        const Real to = glm::length(image[next]);
        const Real edge = glm::length(toCorner[next] - toCorner[i]);
        side[i] = glm::dot(d, glm::cross(image[i], image[next]));
        ourError[i] = moved * (from + to) + 2 * moved * moved + 4 * roundingUnit * from * to;
        theirError[i] = moved * (from + to + edge);
        intersection.longest = std::max(intersection.longest, edge);
    }
    const auto minInside = [&](const std::array<Real, 3> &error) {
        Real positive = side[0] / error[0];
        Real negative = -positive;
        for (std::size_t i = 1; i < 3; ++i) {
            positive = std::min(positive, side[i] / error[i]);
            negative = std::min(negative, -side[i] / error[i]);
        }
        return std::max(positive, negative);
    };
    intersection.ours.inside = minInside(ourError);
    intersection.theirs.inside = minInside(theirError);

    const Vector area = glm::cross(toCorner[1] - toCorner[0], toCorner[2] - toCorner[0]);
    const Real twiceArea = glm::length(area);
    const Real approach = glm::dot(area, d); // also twice the area of the image
    const auto [nearest, farthest] = std::minmax_element(along.begin(), along.end());
    intersection.t =
        approach != 0 ? std::clamp(glm::dot(area, toCorner[0]) / approach, *nearest, *farthest) : *nearest;
    if (twiceArea > 0) {
        intersection.normal = area / twiceArea;
        intersection.cosine = std::abs(approach) / twiceArea;
        intersection.slenderness = intersection.longest * intersection.longest / twiceArea;
    }
    // Ours is a mean of the corners' distances, sheared to the ray, whose weights are the edge functions: off by no
    // more than those are apart. Embree's comes from the plane, whose normal is off by `moved * longest`.
    const Vector size = glm::abs(d);
    const int axis = size.z >= size.x && size.z >= size.y ? 2 : (size.y >= size.x ? 1 : 0);
    const auto [least, most] = std::minmax({toCorner[0][axis], toCorner[1][axis], toCorner[2][axis]});
    const Real span = (most - least) / size[axis];
    const Real weightError = (ourError[0] + ourError[1] + ourError[2]) / std::abs(approach);
    const Real normalError = moved * intersection.longest / std::abs(approach);
    intersection.ours.tError = moved + span * std::min(weightError, Real(1));
    intersection.position = Vector(origin) + d * intersection.t;
    intersection.ourPositionError = moved + intersection.longest * std::min(weightError, Real(1)) +
                                    8 * roundingUnit * (glm::length(Vector(origin)) + intersection.reach);
    intersection.theirs.tError = moved + intersection.longest * normalError;
    return intersection;
}

} // namespace hyalite::core::testing
