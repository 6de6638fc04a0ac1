#include "host/scene/shapes.h"

#include "host/scene/instances.h"
#include "host/scene/origin.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace hyalite::core {

namespace {

std::uint32_t countOf(const TriangleMesh &mesh) { return static_cast<std::uint32_t>(mesh.positions.size()); }

void addPoint(TriangleMesh &mesh, const glm::vec3 &position, const glm::vec2 &uv) {
    mesh.positions.push_back(position);
    mesh.uvs.push_back(uv);
}

void addTriangle(TriangleMesh &mesh, const glm::uvec3 &corners) {
    mesh.triangles.push_back({corners});
    mesh.triangleUvs.push_back(corners);
}

/// Four corners, counter-clockwise.
void addQuad(TriangleMesh &mesh, const std::array<glm::vec3, 4> &corners) {
    const std::uint32_t first = countOf(mesh);
    addPoint(mesh, corners[0], {0.0f, 0.0f});
    addPoint(mesh, corners[1], {1.0f, 0.0f});
    addPoint(mesh, corners[2], {1.0f, 1.0f});
    addPoint(mesh, corners[3], {0.0f, 1.0f});
    addTriangle(mesh, {first, first + 1, first + 2});
    addTriangle(mesh, {first, first + 2, first + 3});
}

void addBox(TriangleMesh &mesh) {
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 normal(0.0f);
            normal[axis] = side;
            glm::vec3 u(0.0f);
            u[(axis + 1) % 3] = 1.0f;
            const glm::vec3 v = glm::cross(normal, u);
            addQuad(mesh, {normal - u - v, normal + u - v, normal + u + v, normal - u + v});
        }
}

/// The corner of a polygon in the unit circle, as a share of a turn.
glm::dvec2 onCircle(int corner, int segments) {
    // Quarter turns are exact, so that a shape of 4 segments is a square.
    const int turned = 4 * corner;
    if (turned % segments == 0) {
        constexpr std::array<glm::dvec2, 4> quarters{{{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}}};
        return quarters[static_cast<std::size_t>(turned / segments % 4)];
    }
    const double angle = 2.0 * std::numbers::pi * corner / segments;
    return {std::cos(angle), std::sin(angle)};
}

/// At the height z, facing +z or, if `isTurned`, -z, from where it is seen with its texture upright, too.
void addDisk(TriangleMesh &mesh, int segments, float z, bool isTurned) {
    const std::uint32_t centre = countOf(mesh);
    addPoint(mesh, {0.0f, 0.0f, z}, {0.5f, 0.5f});
    for (int i = 0; i < segments; ++i) {
        const glm::vec2 place(onCircle(i, segments));
        addPoint(mesh, {place, z},
                 {isTurned ? 0.5f - 0.5f * place.x : 0.5f + 0.5f * place.x, 0.5f + 0.5f * place.y});
    }
    for (int i = 0; i < segments; ++i) {
        const std::uint32_t a = centre + 1 + static_cast<std::uint32_t>(i);
        const std::uint32_t b = centre + 1 + static_cast<std::uint32_t>((i + 1) % segments);
        addTriangle(mesh, isTurned ? glm::uvec3(centre, b, a) : glm::uvec3(centre, a, b));
    }
}

void addSide(TriangleMesh &mesh, int segments) {
    const std::uint32_t first = countOf(mesh);
    for (int i = 0; i <= segments; ++i) { // the seam has two texture coordinates
        const glm::vec2 place(onCircle(i, segments));
        const float u = static_cast<float>(i) / static_cast<float>(segments);
        addPoint(mesh, {place, -1.0f}, {u, 0.0f});
        addPoint(mesh, {place, 1.0f}, {u, 1.0f});
        mesh.normals.emplace_back(place, 0.0f);
    }
    for (int i = 0; i < segments; ++i) {
        const auto normal = static_cast<std::uint32_t>(i);
        const std::uint32_t low = first + 2 * normal;
        addTriangle(mesh, {low, low + 2, low + 3});
        mesh.triangles.back().normals = {normal, normal + 1, normal + 1};
        addTriangle(mesh, {low, low + 3, low + 1});
        mesh.triangles.back().normals = {normal, normal + 1, normal};
    }
}

} // namespace

TriangleMesh makeShape(ShapeKind kind, int segments) {
    TriangleMesh mesh;
    switch (kind) {
    case ShapeKind::Quad:
        addQuad(mesh, {glm::vec3(-1, -1, 0), glm::vec3(1, -1, 0), glm::vec3(1, 1, 0), glm::vec3(-1, 1, 0)});
        break;
    case ShapeKind::Box:
        addBox(mesh);
        break;
    case ShapeKind::Disk:
        addDisk(mesh, segments, 0.0f, false);
        break;
    case ShapeKind::Cylinder:
        addSide(mesh, segments);
        addDisk(mesh, segments, 1.0f, false);
        addDisk(mesh, segments, -1.0f, true);
        break;
    }
    return mesh;
}

TriangleMesh transformed(TriangleMesh mesh, const glm::dmat4x3 &map) {
    if (glm::dot(glm::cross(map[0], map[1]), map[2]) < 0.0)
        mesh = mirrored(std::move(mesh));
    const glm::dmat3 linear(map[0], map[1], map[2]);
    const glm::dvec3 place = linear * mesh.origin + map[3];
    OriginFinder finder;
    (void)std::ranges::all_of(mesh.positions, [&](const glm::vec3 &position) {
        return finder.add(linear * glm::dvec3(position) + place);
    });
    mesh.origin = finder.origin();
    const glm::dvec3 offset = place - mesh.origin;
    for (glm::vec3 &position : mesh.positions)
        position = glm::vec3(linear * glm::dvec3(position) + offset);
    // The inverse transpose, except for a positive factor; scaled first, so that products stay in the range of doubles.
    const double scale = 1.0 / std::max({glm::length(map[0]), glm::length(map[1]), glm::length(map[2])});
    const glm::dvec3 a = map[0] * scale;
    const glm::dvec3 b = map[1] * scale;
    const glm::dvec3 c = map[2] * scale;
    const glm::dmat3 cofactors(glm::cross(b, c), glm::cross(c, a), glm::cross(a, b));
    for (glm::vec3 &normal : mesh.normals)
        normal = glm::vec3(glm::normalize(cofactors * glm::dvec3(normal)));
    for (glm::vec4 &tangent : mesh.tangents.values) {
        const glm::dvec3 turned = linear * glm::dvec3(tangent);
        const double length = glm::length(turned);
        if (length > 0.0)
            tangent = glm::vec4(glm::vec3(turned / length), tangent.w);
    }
    return mesh;
}

} // namespace hyalite::core
