#include "host/packing/media_at.h"

#include "host/scene/instances.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hyalite {

namespace {

/// The solid angle of a triangle seen from the origin, positive if it is seen from behind: van Oosterom and Strackee, "The
/// Solid Angle of a Plane Triangle", 1983.
double solidAngle(const glm::dvec3 &a, const glm::dvec3 &b, const glm::dvec3 &c) {
    const double volume = glm::dot(a, glm::cross(b, c));
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    return 2.0 *
           std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

/// Adds to `windings`, of each material, how often the mesh winds around the origin. `place` brings corners there.
template <class Place>
void addWindings(const Scene &scene, const TriangleMesh &mesh, const Place &place,
                 std::vector<double> &windings) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t material = mesh.materialOf(i);
        if (!isGlass(scene.materials[material]))
            continue;
        const glm::uvec3 &corners = mesh.triangles[i].positions;
        windings[material] += solidAngle(place(mesh.positions[corners.x]), place(mesh.positions[corners.y]),
                                         place(mesh.positions[corners.z])) /
                              (4.0 * std::numbers::pi);
    }
}

} // namespace

std::uint32_t mediaAt(const Scene &scene, std::span<const std::uint32_t> packedMaterial,
                      const glm::dvec3 &point) {
    if (std::ranges::none_of(scene.materials, isGlass))
        return 0;
    std::vector<double> windings(scene.materials.size(), 0.0);
    for (const Sphere &sphere : scene.spheres)
        if (isGlass(scene.materials[sphere.materialIndex]) &&
            glm::distance(point, sphere.centre) < sphere.radius)
            windings[sphere.materialIndex] += sphere.inwardNormal ? -1.0 : 1.0;
    for (const TriangleMesh &mesh : scene.meshes)
        addWindings(
            scene, mesh, [&](const glm::vec3 &corner) { return glm::dvec3(corner) - point; }, windings);
    for (const Instance &instance : scene.instances)
        addWindings(
            scene, scene.prototypes[instance.prototype],
            [&](const glm::vec3 &corner) {
                return glm::dvec3(placedPoint(instance.toWorld, corner)) - point;
            },
            windings);
    std::uint32_t media = 0;
    for (std::size_t i = 0; i < windings.size(); ++i)
        if (packedMaterial[i] < layout::maxMedia)
            media |= static_cast<std::uint32_t>(std::clamp(std::lround(windings[i]), 0l, 15l))
                     << packedMaterial[i] * layout::mediumBits;
    return media;
}

} // namespace hyalite
