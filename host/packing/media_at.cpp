#include "host/packing/media_at.h"

#include "host/scene/instances.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hyalite::core {

namespace {

/// The solid angle of a triangle seen from the origin, positive if it is seen from behind: van Oosterom and Strackee,
/// "The Solid Angle of a Plane Triangle", 1983.
double solidAngle(const glm::dvec3 &a, const glm::dvec3 &b, const glm::dvec3 &c) {
    const double volume = glm::dot(a, glm::cross(b, c));
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    return 2.0 *
           std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

/// Adds to `windings`, of each material, how often the mesh winds around zero. `place` brings corners there. Returns
/// whether the box of a triangle of glass reaches into the one around zero.
template <class Place>
bool addWindings(const Scene &scene, const TriangleMesh &mesh, const Place &place, const glm::dvec3 &spread,
                 std::vector<double> &windings) {
    bool isNear = false;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t material = mesh.materialOf(i);
        if (!holdsMedium(scene.materials[material]))
            continue;
        const glm::uvec3 &corners = mesh.triangles[i].positions;
        const glm::dvec3 a = place(mesh.positions[corners.x]);
        const glm::dvec3 b = place(mesh.positions[corners.y]);
        const glm::dvec3 c = place(mesh.positions[corners.z]);
        windings[material] += solidAngle(a, b, c) / (4.0 * std::numbers::pi);
        isNear = isNear || (glm::all(glm::lessThanEqual(glm::min(glm::min(a, b), c), spread)) &&
                            glm::all(glm::lessThanEqual(-spread, glm::max(glm::max(a, b), c))));
    }
    return isNear;
}

} // namespace

MediaAt mediaAt(const Scene &scene, std::span<const std::uint32_t> packedMaterial, const glm::dvec3 &point,
                const glm::dvec3 &spread) {
    MediaAt media;
    if (std::ranges::none_of(scene.materials, holdsMedium))
        return media;
    std::vector<double> windings(scene.materials.size(), 0.0);
    for (const Sphere &sphere : scene.spheres) {
        if (!holdsMedium(scene.materials[sphere.materialIndex]))
            continue;
        const double distance = glm::distance(point, sphere.centre);
        if (distance < sphere.radius)
            windings[sphere.materialIndex] += sphere.inwardNormal ? -1.0 : 1.0;
        media.isSurfaceNear |= std::abs(distance - sphere.radius) <= glm::length(spread);
    }
    for (const TriangleMesh &mesh : scene.meshes)
        media.isSurfaceNear |= addWindings(
            scene, mesh, [&](const glm::vec3 &corner) { return glm::dvec3(corner) - point; }, spread,
            windings);
    for (const Instance &instance : scene.instances)
        media.isSurfaceNear |= addWindings(
            scene, scene.prototypes[instance.prototype],
            [&](const glm::vec3 &corner) {
                return glm::dvec3(placedPoint(instance.toWorld, corner)) - point;
            },
            spread, windings);
    for (std::size_t i = 0; i < windings.size(); ++i)
        if (packedMaterial[i] < layout::maxMedia)
            media.around |= static_cast<std::uint32_t>(std::clamp(std::lround(windings[i]), 0l, 15l))
                            << packedMaterial[i] * layout::mediumBits;
    return media;
}

} // namespace hyalite::core
