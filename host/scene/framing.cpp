#include "host/scene/framing.h"

#include "host/base/error.h"
#include "host/scene/instances.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace hyalite::core {
namespace {

constexpr double margin = 0.08; ///< fraction of half the image that stays free at each edge
constexpr float neutralAlbedo = 0.8f;
/// In half diagonals: far enough to light near and far side about equally.
constexpr double lightDistance = 10.0;
constexpr double keyRadiance = 0.7;
constexpr double fillRadiance = 0.2;

double halfDiagonal(const Bounds &bounds) { return 0.5 * glm::length(bounds.high - bounds.low); }

/// The axes of an object whose up is not +y: those of the world, turned the short way.
struct Axes {
    glm::dvec3 right{1.0, 0.0, 0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 front{0.0, 0.0, 1.0};
};

Axes axesOf(const glm::dvec3 &up) {
    if (up == Axes{}.up)
        return {}; // to the bit
    if (up.y < -0.999999)
        return {{1.0, 0.0, 0.0}, up, {0.0, 0.0, -1.0}};
    // Rodrigues' formula for the turn that takes +y to `up`, about (up.z, 0, -up.x).
    const double share = 1.0 / (1.0 + up.y);
    return {{1.0 - share * up.x * up.x, -up.x, -share * up.x * up.z},
            up,
            {-share * up.x * up.z, -up.z, 1.0 - share * up.z * up.z}};
}

/// The unit vector `azimuth` from the front to the right and `elevation` above the horizon.
glm::dvec3 towards(const Axes &axes, double azimuthDegrees, double elevationDegrees) {
    const double azimuth = glm::radians(azimuthDegrees);
    const double elevation = glm::radians(elevationDegrees);
    const glm::dvec3 local(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                           std::cos(elevation) * std::cos(azimuth));
    return local.x * axes.right + local.y * axes.up + local.z * axes.front;
}

/// A light under which a neutral surface at the box centre, facing the light, has the given radiance:
/// radiance = power / (4 pi d^2) * albedo / pi.
Light lightFrom(const glm::dvec3 &direction, double radiance, const Bounds &bounds) {
    const double distance = lightDistance * halfDiagonal(bounds);
    const double power =
        radiance * 4.0 * std::numbers::pi * std::numbers::pi * distance * distance / double{neutralAlbedo};
    return {bounds.centre() + distance * direction, glm::dvec3(power)};
}

/// The fill light stands beside the camera, so the camera does not see its shadows.
std::vector<Light> lightsFrom(const Bounds &bounds, const Axes &axes, double eyeAzimuthDegrees) {
    return {lightFrom(towards(axes, eyeAzimuthDegrees - 70.0, 45.0), keyRadiance, bounds),
            lightFrom(towards(axes, eyeAzimuthDegrees + 5.0, 22.0), fillRadiance, bounds)};
}

/// Makes the box enclose the mesh, whose positions are where `place` brings them.
template <class Place> void enclose(Bounds &bounds, const TriangleMesh &mesh, const Place &place) {
    for (const MeshTriangle &triangle : mesh.triangles)
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 position =
                glm::dvec3(place(mesh.positions[triangle.positions[corner]])) + mesh.origin;
            bounds.low = glm::min(bounds.low, position);
            bounds.high = glm::max(bounds.high, position);
        }
}

} // namespace

void requireFramed(const Bounds &bounds, const std::string &name) {
    if (!(bounds.low.x <= bounds.high.x))
        throw Error(ErrorKind::BadInput, fmt::format("{}: has no triangle to look at", name));
    const double extent = 2.0 * halfDiagonal(bounds);
    if (!limits::framedExtent.contains(extent))
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: the mesh is {:g} across, and a camera is placed for meshes {}; write a "
                                "scene file that scales it",
                                name, extent, limits::framedExtent.text()));
}

Bounds triangleBounds(const TriangleMesh &mesh) {
    Bounds bounds = noBounds;
    enclose(bounds, mesh, [](const glm::vec3 &position) { return position; });
    requireFramed(bounds, mesh.name);
    return bounds;
}

Bounds triangleBounds(const Scene &scene, const std::string &name) {
    Bounds bounds = noBounds;
    for (const TriangleMesh &mesh : scene.meshes)
        enclose(bounds, mesh, [](const glm::vec3 &position) { return position; });
    for (const Instance &instance : scene.instances)
        enclose(bounds, scene.prototypes[instance.prototype],
                [&](const glm::vec3 &position) { return placedPoint(instance.toWorld, position); });
    requireFramed(bounds, name);
    return bounds;
}

glm::dvec3 directionOf(const ViewDirection &view) {
    return towards({}, view.azimuthDegrees, view.elevationDegrees);
}

Camera frameCamera(const Bounds &bounds, int width, int height, double horizontalFovDegrees,
                   const glm::dvec3 &worldUp, const ViewDirection &from) {
    assert(width >= 1 && height >= 1 && limits::horizontalFovDegrees.contains(horizontalFovDegrees));
    const Axes axes = axesOf(worldUp);
    // From the box to the camera.
    const glm::dvec3 backwards = towards(axes, from.azimuthDegrees, from.elevationDegrees);
    const bool isVertical = std::abs(from.elevationDegrees) > 89.0;
    const glm::dvec3 imageUp =
        isVertical ? towards(axes, from.azimuthDegrees, from.elevationDegrees + 90.0) : worldUp;
    const glm::dvec3 right = glm::normalize(glm::cross(imageUp, backwards));
    const glm::dvec3 up = glm::cross(backwards, right);
    const double tangentX = (1.0 - margin) * std::tan(glm::radians(0.5 * horizontalFovDegrees));
    const double tangentY = tangentX * height / width;

    // A corner p from the centre is seen within the margin if |p.right| <= tangentX * (distance - p.backwards),
    // and so for up. The camera also keeps clear of the box, which matters for wide fields of view.
    const glm::dvec3 centre = bounds.centre();
    double distance = 1.5 * halfDiagonal(bounds);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p = glm::dvec3((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                                        (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                                        (corner & 4) != 0 ? bounds.high.z : bounds.low.z) -
                             centre;
        const double depth = glm::dot(p, backwards);
        distance = std::max({distance, depth + std::abs(glm::dot(p, right)) / tangentX,
                             depth + std::abs(glm::dot(p, up)) / tangentY});
    }

    Camera camera;
    camera.position = centre + distance * backwards;
    camera.direction = -backwards;
    camera.up = imageUp;
    camera.horizontalFovDegrees = horizontalFovDegrees;
    camera.width = width;
    camera.height = height;
    return camera;
}

double horizontalFovDegrees(double verticalFovDegrees, int width, int height) {
    const double tangent = std::tan(glm::radians(0.5 * verticalFovDegrees)) * width / height;
    return glm::degrees(2.0 * std::atan(tangent));
}

std::vector<Light> frameLights(const Bounds &bounds, const glm::dvec3 &up, const glm::dvec3 &eye) {
    const Axes axes = axesOf(up);
    const glm::dvec3 way = eye - bounds.centre();
    const double azimuth = glm::degrees(std::atan2(glm::dot(way, axes.right), glm::dot(way, axes.front)));
    return lightsFrom(bounds, axes, azimuth); // 0 for an eye right above
}

std::vector<Light> frameLights(const Bounds &bounds, const Camera &camera) {
    const glm::dvec3 backwards = -glm::normalize(camera.direction);
    const glm::dvec3 right = glm::normalize(glm::cross(camera.up, backwards));
    const Axes axes{right, glm::cross(backwards, right), backwards};
    const Axes ofMesh{{1.0, 0.0, 0.0},
                      towards({}, 0.0, defaultView.elevationDegrees + 90.0),
                      towards({}, 0.0, defaultView.elevationDegrees)};
    std::vector<Light> lights = lightsFrom(bounds, {}, 0.0);
    for (Light &light : lights) {
        const glm::dvec3 way = light.position - bounds.centre();
        light.position = bounds.centre() + glm::dot(way, ofMesh.right) * axes.right +
                         glm::dot(way, ofMesh.up) * axes.up + glm::dot(way, ofMesh.front) * axes.front;
    }
    return lights;
}

Material neutralMaterial(bool hasColours) {
    Material neutral;
    neutral.name = "neutral";
    neutral.albedo = glm::vec3(hasColours ? 1.0f : neutralAlbedo);
    neutral.twoSided = true;
    return neutral;
}

Scene frameMesh(TriangleMesh mesh) {
    Scene scene;
    scene.origin = std::exchange(mesh.origin, glm::dvec3(0.0));
    const Bounds bounds = triangleBounds(mesh);
    scene.camera = frameCamera(bounds, scene.camera.width, scene.camera.height, defaultFovDegrees);
    scene.lights = lightsFrom(bounds, {}, defaultView.azimuthDegrees);
    scene.background = frameBackground;
    scene.materials = {neutralMaterial(!mesh.colours.corners.empty())};
    mesh.materialIndex = 0;
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

} // namespace hyalite::core
