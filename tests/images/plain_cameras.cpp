#include "tests/images/plain_cameras.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <numbers>

namespace hyalite::core::testing::plain {

namespace {

constexpr double pi = std::numbers::pi;

/// Cook, Porter and Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984: rays through all of the lens meet at what a
/// pinhole shows in the plane that is sharp. Points of the lens are drawn from a square until one is in the disc.
Vec pointOfLens(const Camera &camera, const Vec &right, const Vec &up, Generator &generator) {
    for (;;) {
        const double a = 2.0 * uniform(generator) - 1.0;
        const double b = 2.0 * uniform(generator) - 1.0;
        if (a * a + b * b <= 1.0)
            return camera.position + 0.5 * camera.aperture * (a * right + b * up);
    }
}

} // namespace

Ray primaryRay(const Camera &camera, double x, double y, Generator &generator) {
    const Vec forward = glm::normalize(camera.direction);
    const Vec right = glm::normalize(glm::cross(forward, camera.up));
    const Vec up = glm::cross(right, forward);
    if (camera.kind == CameraKind::Panorama) {
        const double longitude = 2.0 * pi * (x / camera.width - 0.5); // from the view direction to the right
        const double latitude = pi * (0.5 - y / camera.height);       // up
        return {camera.position,
                std::cos(latitude) * (std::cos(longitude) * forward + std::sin(longitude) * right) +
                    std::sin(latitude) * up};
    }
    const double fromLeft = x / camera.width - 0.5; // in units of the image's width
    const double fromBottom = (0.5 * camera.height - y) / camera.width;
    if (camera.kind == CameraKind::Orthographic)
        return {camera.position + camera.viewWidth * (fromLeft * right + fromBottom * up), forward};
    const double width = 2.0 * std::tan(glm::radians(camera.horizontalFovDegrees) / 2.0); // at distance 1
    const Vec towards = forward + width * (fromLeft * right + fromBottom * up);
    if (camera.aperture == 0.0)
        return {camera.position, glm::normalize(towards)};
    const Vec origin = pointOfLens(camera, right, up, generator);
    return {origin, glm::normalize(camera.position + camera.focusDistance * towards - origin)};
}

/// The product of two windows of four terms, 3 pixels wide: Harris, "On the Use of Windows for Harmonic Analysis with
/// the Discrete Fourier Transform", Proc. IEEE 66(1), 1978, equation 33. Drawn by rejection.
Vec2 randomOffset(FilterKind filter, Generator &generator) {
    if (filter == FilterKind::Box)
        return {uniform(generator) - 0.5, uniform(generator) - 0.5};
    const auto draw = [&] {
        for (;;) {
            const double share = uniform(generator);
            const double turn = 2.0 * pi * share;
            const double height = 0.35875 - 0.48829 * std::cos(turn) + 0.14128 * std::cos(2.0 * turn) -
                                  0.01168 * std::cos(3.0 * turn);
            if (uniform(generator) < height)
                return 3.0 * share - 1.5;
        }
    };
    return {draw(), draw()};
}

} // namespace hyalite::core::testing::plain
