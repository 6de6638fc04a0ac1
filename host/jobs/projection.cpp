#include "host/jobs/projection.h"

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

} // namespace

std::optional<Projection> projectionOf(const Scene &scene) {
    const Camera &camera = scene.camera;
    if (camera.kind == CameraKind::Panorama)
        return std::nullopt;
    const bool isFlat = camera.kind == CameraKind::Orthographic;
    const double windowWidth =
        isFlat ? camera.viewWidth : 2.0 * std::tan(glm::radians(camera.horizontalFovDegrees) / 2.0);
    const glm::dmat4 toCamera = worldToCamera(camera, camera.position + scene.origin);
    return Projection{valuesOf(toCamera), valuesOf(cameraToNdc(camera, windowWidth) * toCamera),
                      isFlat ? 1.0 : windowWidth};
}

} // namespace hyalite::core
