#include "tests/images/plain_lights.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace hyalite::core::testing::plain {

namespace {

constexpr double pi = std::numbers::pi;

/// Share of a spot's intensity: the cubic of the cosine that is even where it begins and where it ends, or a square.
double falloff(const Light &spot, double cosine) {
    const double outer = std::cos(glm::radians(spot.angleDegrees));
    const double inner = std::cos(glm::radians(spot.angleDegrees * (1.0 - spot.blend)));
    if (cosine <= outer)
        return 0.0;
    if (cosine >= inner)
        return 1.0;
    const double t = (cosine - outer) / (inner - outer);
    return spot.fade == SpotFade::Square ? t * t : 3.0 * t * t - 2.0 * t * t * t;
}

/// Between which of ascending angles one is: the index of the first one, and the share of the second one.
std::pair<std::size_t, double> between(const std::vector<double> &angles, double angle) {
    for (std::size_t i = 0; i + 1 < angles.size(); ++i)
        if (angle >= angles[i] && angle <= angles[i + 1])
            return {i, (angle - angles[i]) / (angles[i + 1] - angles[i])};
    return {0, 0.0};
}

/// Share of the greatest intensity in a direction away from the lamp, of unit length. Seen from above, with the lamp's
/// direction down and C = 0 to the right, C grows counter-clockwise.
double profileShareOf(const LightProfile &profile, const Light &light, const Vec &away) {
    const Vec down = glm::normalize(light.direction);
    const Vec right = glm::normalize(light.c0 - down * glm::dot(down, light.c0));
    const Vec up = glm::cross(-down, right);
    const double gamma = glm::degrees(std::acos(std::clamp(glm::dot(away, down), -1.0, 1.0)));
    const double turned = glm::degrees(std::atan2(glm::dot(away, up), glm::dot(away, right)));
    if (gamma < profile.gammas.front() || gamma > profile.gammas.back())
        return 0.0;
    const std::size_t count = profile.gammas.size();
    const auto [row, below] = between(profile.gammas, gamma);
    const auto inPlane = [&, first = row, share = below](std::size_t plane) {
        return (1.0 - share) * static_cast<double>(profile.shares[plane * count + first]) +
               share * static_cast<double>(profile.shares[plane * count + first + 1]);
    };
    if (profile.planes.size() == 1)
        return inPlane(0);
    const auto [plane, around] = between(profile.planes, turned < 0.0 ? turned + 360.0 : turned);
    return (1.0 - around) * inPlane(plane) + around * inPlane(plane + 1);
}

} // namespace

Arrival arrivalFrom(const Scene &scene, const Light &light, const Vec &position) {
    const Vec axis = glm::normalize(light.direction);
    if (light.kind == LightKind::Directional)
        return {-axis, std::numeric_limits<double>::infinity(), light.power};
    const double distance = glm::length(light.position - position);
    const Vec direction = (light.position - position) / distance;
    double share = light.kind == LightKind::Spot ? falloff(light, -glm::dot(direction, axis)) : 1.0;
    if (light.profile)
        share *= profileShareOf(scene.profiles[*light.profile], light, -direction);
    return {direction, distance, light.power * (share / (4.0 * pi * distance * distance))};
}

/// Bilinear between the middles of pixels. The image goes around and ends at the poles; it is turned with the world, so
/// the direction is turned back.
Vec surroundings(const Scene &scene, const Vec &direction) {
    const Image &image = scene.environment.radiance;
    if (image.pixels().empty())
        return scene.background;
    const double turn = glm::radians(scene.environment.rotateDegrees);
    const double right = std::cos(turn) * direction.x - std::sin(turn) * direction.z;
    const double back = std::sin(turn) * direction.x + std::cos(turn) * direction.z;
    const double x = (0.5 + std::atan2(right, -back) / (2.0 * pi)) * image.width() - 0.5;
    const double y = std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi * image.height() - 0.5;
    Vec sum(0.0);
    for (const double across : {0.0, 1.0})
        for (const double down : {0.0, 1.0}) {
            const double column = std::floor(x) + across;
            const double row = std::floor(y) + down;
            const double weight = (1.0 - std::abs(x - column)) * (1.0 - std::abs(y - row));
            const int width = image.width();
            sum += weight * Vec(image.at((static_cast<int>(column) + width) % width,
                                         std::clamp(static_cast<int>(row), 0, image.height() - 1)));
        }
    return sum * static_cast<double>(scene.environment.scale);
}

Emitters::Emitters(const Scene &scene, const std::vector<Shape> &shapes) {
    double end = 0.0;
    for (const Shape &shape : shapes) {
        if (scene.materials[shape.materialIndex].emission == glm::vec3(0.0f))
            continue;
        end += shape.area();
        shapes_.push_back(&shape);
        ends_.push_back(end);
    }
}

Emitters::Choice Emitters::choose(Generator &generator) const {
    const auto end = std::upper_bound(ends_.begin(), ends_.end() - 1, area() * uniform(generator));
    const Shape *shape = shapes_[static_cast<std::size_t>(end - ends_.begin())];
    return {shape, shape->randomPoint(generator)};
}

} // namespace hyalite::core::testing::plain
