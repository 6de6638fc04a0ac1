// First hits of a picture: which primitive each pixel shows, and where.
#pragma once

#include "host/image/crop.h"
#include "host/packing/packed_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <span>

namespace hyalite::core::reference {

struct FirstHit {
    std::uint32_t primitive = layout::noPrimitive;
    double u = 0.0; ///< of a triangle: the weights of its first and second corner
    double v = 0.0;
    glm::dvec3 position{0.0};
};

/// The point of a triangle with these weights of its first and second corner.
template <class Triangle> [[nodiscard]] glm::dvec3 pointIn(const Triangle &triangle, double u, double v) {
    return glm::dvec3(triangle.v0) * u + glm::dvec3(triangle.v1) * v +
           glm::dvec3(triangle.v2) * (1.0 - u - v);
}

/// The hits of a row of the crop, from left to right.
using VisitRow = std::function<void(int y, std::span<const FirstHit> hits)>;

/// Traces the primary ray through the centre of each pixel, of a lens through its centre, on all threads. One of them
/// at a time visits a row; rows come in any order.
void visitFirstHits(const PackedScene &scene, const Crop &crop, const VisitRow &visit);

} // namespace hyalite::core::reference
