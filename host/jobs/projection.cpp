#include "host/jobs/projection.h"

#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>

namespace hyalite::core {

namespace {

/// A matrix of glm, which multiplies columns and is stored by columns, has the layout of one that multiplies rows and is
/// stored by rows.
std::array<double, 16> valuesOf(const glm::dmat4 &matrix) {
    std::array<double, 16> values{};
    for (glm::length_t i = 0; i < 16; ++i)
        values[static_cast<std::size_t>(i)] = matrix[i / 4][i % 4];
    return values;
}

glm::dmat4 worldToCamera(const Camera &camera, const glm::dvec3 &eye) {
    const glm::dvec3 forward = glm::normalize(camera.direction);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    return {{right.x, up.x, forward.x, 0.0},
            {right.y, up.y, forward.y, 0.0},
            {right.z, up.z, forward.z, 0.0},
            {-glm::dot(right, eye), -glm::dot(up, eye), -glm::dot(forward, eye), 1.0}};
}

/// x to the right, y down, both from 0 to 1 over a window of this width: at the distance 1, or at all.
glm::dmat4 cameraToNdc(const Camera &camera, double windowWidth) {
    const double across = 1.0 / windowWidth;
    const double down = -across * camera.width / camera.height;
    if (camera.kind == CameraKind::Orthographic)
        return {{across, 0.0, 0.0, 0.0}, {0.0, down, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.5, 0.5, 0.0, 1.0}};
    return {{across, 0.0, 0.0, 0.0}, {0.0, down, 0.0, 0.0}, {0.5, 0.5, 1.0, 1.0}, {0.0, 0.0, -1.0, 0.0}};
}

/// At the distance 1, or at all.
double windowWidthOf(const Camera &camera) {
    return camera.kind == CameraKind::Orthographic
               ? camera.viewWidth
               : 2.0 * std::tan(glm::radians(camera.horizontalFovDegrees) / 2.0);
}

/// Of a direction in camera space, both from 0 to 1: the middle is the view direction, the top row is up.
glm::dvec2 panoramaNdc(const glm::dvec3 &direction) {
    const double turns = std::atan2(direction.x, direction.z) / (2.0 * glm::pi<double>());
    return {0.5 + turns, std::acos(direction.y / glm::length(direction)) / glm::pi<double>()};
}

} // namespace

std::optional<Projection> projectionOf(const Scene &scene) {
    const Camera &camera = scene.camera;
    if (camera.kind == CameraKind::Panorama)
        return std::nullopt;
    const bool isFlat = camera.kind == CameraKind::Orthographic;
    const double windowWidth = windowWidthOf(camera);
    const glm::dmat4 toCamera = worldToCamera(camera, camera.position + scene.origin);
    return Projection{valuesOf(toCamera), valuesOf(cameraToNdc(camera, windowWidth) * toCamera),
                      isFlat ? 1.0 : windowWidth};
}

std::optional<glm::dvec2> pixelOf(const Camera &camera, const glm::dvec3 &point) {
    const glm::dvec2 size(camera.width, camera.height);
    const glm::dvec4 local = worldToCamera(camera, camera.position) * glm::dvec4(point, 1.0);
    if (camera.kind == CameraKind::Panorama)
        return panoramaNdc(glm::dvec3(local)) * size;
    const glm::dvec4 ndc = cameraToNdc(camera, windowWidthOf(camera)) * local;
    if (!(ndc.w > 0.0))
        return std::nullopt;
    return glm::dvec2(ndc) / ndc.w * size;
}

} // namespace hyalite::core
