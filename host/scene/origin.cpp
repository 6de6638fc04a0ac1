#include "host/scene/origin.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace hyalite::core {

namespace {

double largestCoordinate(const glm::dvec3 &v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

double extentOf(const Bounds &bounds) { return largestCoordinate(bounds.high - bounds.low); }

/// Of the nearest point, by its largest coordinate. More points make the extent larger and the distance smaller.
double distanceOf(const Bounds &bounds) {
    return largestCoordinate(glm::max(glm::max(bounds.low, -bounds.high), glm::dvec3(0.0)));
}

bool isFar(const Bounds &bounds) {
    constexpr double tiny = std::numeric_limits<float>::min();
    return distanceOf(bounds) > std::max(farExtents * extentOf(bounds), tiny);
}

Bounds boundsOf(const std::vector<glm::vec3> &positions) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const glm::vec3 &position : positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    return {glm::dvec3(low), glm::dvec3(high)};
}

/// Adds the corners of the triangles. Returns whether the points so far are far.
bool addTriangles(const TriangleMesh &mesh, OriginFinder &finder) {
    return std::ranges::all_of(mesh.triangles, [&](const MeshTriangle &triangle) {
        const auto add = [&](std::uint32_t corner) {
            return finder.add(glm::dvec3(mesh.positions[corner]) + mesh.origin);
        };
        return add(triangle.positions.x) && add(triangle.positions.y) && add(triangle.positions.z);
    });
}

bool addSphere(const Sphere &sphere, OriginFinder &finder) {
    return finder.add(sphere.centre - sphere.radius) && finder.add(sphere.centre + sphere.radius);
}

glm::dvec3 exactOffset(const Placement &place) { return glm::dvec3(place.offset) + place.offsetRest; }

/// Adds the boxes of prototypes where instances have them.
void addPlaces(const Scene &scene, OriginFinder &finder) {
    std::vector<std::optional<Bounds>> boxes(scene.prototypes.size()); // of those that were looked at
    for (const Instance &instance : scene.instances) {
        std::optional<Bounds> &box = boxes[instance.prototype];
        if (!box)
            box = boundsOf(scene.prototypes[instance.prototype].positions);
        const Placement &place = instance.toWorld;
        const glm::dmat3 linear = glm::transpose(glm::dmat3(place.rows[0], place.rows[1], place.rows[2]));
        if (!finder.addBox(*box, {linear[0], linear[1], linear[2], exactOffset(place)}))
            return;
    }
}

glm::dvec3 originOf(const Scene &scene) {
    OriginFinder finder;
    const bool areFar =
        std::ranges::all_of(scene.spheres, [&](const Sphere &sphere) { return addSphere(sphere, finder); }) &&
        std::ranges::all_of(scene.meshes,
                            [&](const TriangleMesh &mesh) { return addTriangles(mesh, finder); });
    if (areFar)
        addPlaces(scene, finder);
    return finder.origin();
}

} // namespace

glm::dvec3 originOf(const Bounds &bounds) {
    if (!isFar(bounds))
        return glm::dvec3(0.0);
    // A point's own steps in double precision are smaller.
    const double least = 2.0 * std::max(extentOf(bounds), 1e-12 * distanceOf(bounds));
    const std::array<double, 2> cells{std::pow(10.0, std::floor(std::log10(least)) + 1.0),
                                      std::exp2(std::floor(std::log2(least)) + 1.0)};
    glm::dvec3 origin;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double centre = bounds.centre()[axis];
        const auto rounded = [&](double cell) { return std::round(centre / cell) * cell; };
        const auto distance = [&](double cell) { return std::abs(rounded(cell) - centre); };
        origin[axis] = rounded(*std::ranges::min_element(cells, {}, distance));
    }
    return origin;
}

bool OriginFinder::add(const glm::dvec3 &point) {
    bounds_.low = glm::min(bounds_.low, point);
    bounds_.high = glm::max(bounds_.high, point);
    return isFar(bounds_);
}

bool OriginFinder::addBox(const Bounds &box, const glm::dmat4x3 &map) {
    bool areFar = true;
    for (unsigned corner = 0; corner < 8; ++corner) {
        glm::dvec3 point;
        for (glm::length_t axis = 0; axis < 3; ++axis)
            point[axis] = (corner >> axis & 1u) != 0 ? box.high[axis] : box.low[axis];
        areFar = add(glm::dmat3(map) * point + map[3]);
    }
    return areFar;
}

glm::dvec3 OriginFinder::origin() const { return isEmpty() ? glm::dvec3(0.0) : originOf(bounds_); }

glm::dvec3 originOf(const TriangleMesh &mesh) {
    OriginFinder finder;
    if (mesh.triangles.empty())
        (void)std::ranges::all_of(mesh.positions, [&](const glm::vec3 &position) {
            return finder.add(glm::dvec3(position) + mesh.origin);
        });
    else
        (void)addTriangles(mesh, finder);
    return finder.origin();
}

void moveNear(Scene &scene, CameraPath &path, const std::optional<glm::dvec3> &known) {
    if (scene.origin != glm::dvec3(0.0))
        return;
    const glm::dvec3 origin = known ? *known : originOf(scene);
    scene.origin = origin;
    scene.camera.position -= origin;
    for (CameraPose &pose : path)
        pose.position -= origin;
    for (Light &light : scene.lights)
        if (light.kind != LightKind::Directional)
            light.position -= origin;
    for (Sphere &sphere : scene.spheres)
        sphere.centre -= origin;
    for (TriangleMesh &mesh : scene.meshes) {
        if (const glm::dvec3 shift = mesh.origin - origin; shift != glm::dvec3(0.0))
            for (glm::vec3 &position : mesh.positions)
                position = glm::vec3(glm::dvec3(position) + shift);
        mesh.origin = glm::dvec3(0.0);
    }
    for (Instance &instance : scene.instances) {
        Placement &place = instance.toWorld;
        place.offset = glm::vec3(exactOffset(place) - origin);
        place.offsetRest = glm::dvec3(0.0);
    }
}

} // namespace hyalite::core
