#include "host/import/neutral_environment.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hyalite::core {
namespace {

constexpr int width = 512;
constexpr int height = 256;
constexpr double meanRadiance = 0.7;
constexpr double floorRadiance = 0.25;
constexpr double ceilingRadiance = 0.75;

/// A light of soft edges around a direction.
struct SoftBox {
    double azimuthDegrees;   ///< from +z, where viewers stand, towards +x
    double elevationDegrees; ///< above the horizon
    double halfWidthDegrees;
    double halfHeightDegrees;
    double radiance;
};

constexpr auto softBoxes = std::to_array<SoftBox>(
    {{-50.0, 35.0, 24.0, 30.0, 4.0}, {65.0, 20.0, 18.0, 34.0, 2.0}, {180.0, 68.0, 60.0, 16.0, 4.5}});

/// From 1 within the half width to 0 a third of it beyond.
double soft(double angleDegrees, double halfDegrees) {
    const double t = std::clamp((std::abs(angleDegrees) - halfDegrees) / (halfDegrees / 3.0), 0.0, 1.0);
    return 1.0 - t * t * (3.0 - 2.0 * t);
}

double radianceTowards(double azimuthDegrees, double elevationDegrees) {
    const double up = 0.5 + 0.5 * std::sin(elevationDegrees * std::numbers::pi / 180.0);
    double radiance = floorRadiance + (ceilingRadiance - floorRadiance) * up;
    for (const SoftBox &box : softBoxes) {
        const double across = std::remainder(azimuthDegrees - box.azimuthDegrees, 360.0);
        radiance += box.radiance * soft(across, box.halfWidthDegrees) *
                    soft(elevationDegrees - box.elevationDegrees, box.halfHeightDegrees);
    }
    return radiance;
}

} // namespace

Image neutralEnvironment() {
    Image image(width, height);
    double sum = 0.0;
    double weightSum = 0.0;
    auto pixel = image.pixels().begin();
    for (int y = 0; y < height; ++y) {
        const double elevation = 90.0 - 180.0 * (y + 0.5) / height;
        const double weight = std::cos(elevation * std::numbers::pi / 180.0); // the solid angle of the row
        for (int x = 0; x < width; ++x, ++pixel) {
            // The first column looks along +z, a quarter further along -x.
            const double radiance = radianceTowards(-360.0 * (x + 0.5) / width, elevation);
            sum += weight * radiance;
            weightSum += weight;
            *pixel = glm::vec3(static_cast<float>(radiance));
        }
    }
    const auto scale = static_cast<float>(meanRadiance * weightSum / sum);
    for (glm::vec3 &scaled : image.pixels())
        scaled *= scale;
    return image;
}

} // namespace hyalite::core
