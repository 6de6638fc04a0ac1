#include "host/import/gltf/lights.h"

#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>
#include <vector>

namespace hyalite::core::gltf {
namespace {

constexpr auto kinds = std::to_array<std::pair<std::string_view, LightKind>>(
    {{"point", LightKind::Point}, {"spot", LightKind::Spot}, {"directional", LightKind::Directional}});

void readSpot(const Document &document, const JsonObject &object, Light &light) {
    constexpr double right = std::numbers::pi / 2.0;
    const JsonObject spot(object.at("spot"));
    const double outer =
        clampedNumber(document, spot, "outerConeAngle", {0.0, right}, std::numbers::pi / 4.0);
    if (outer == 0.0)
        spot.at("outerConeAngle").refuse("more than 0");
    // Where the angles are equal the edge is hard: then the formula divides by nothing.
    const double inner = clampedNumber(document, spot, "innerConeAngle", {0.0, outer}, 0.0);
    light.angleDegrees = glm::degrees(outer);
    light.blend = (outer - inner) / outer;
    light.fade = SpotFade::Square;
}

} // namespace

std::optional<Light> readLight(const Document &document, const JsonObject &node,
                               const glm::dmat4x3 &toWorld) {
    const std::optional<JsonObject> use = extensionOf(node, "KHR_lights_punctual");
    if (!use)
        return std::nullopt;
    const JsonNode index = use->at("light");
    const std::optional<JsonObject> extension = extensionOf(document.top(), "KHR_lights_punctual");
    const Elements lights = extension ? elementsOf(*extension, "lights") : Elements();
    if (lights.empty())
        index.refuse("an index of /extensions/KHR_lights_punctual/lights, of which there are none");
    const JsonNode lightNode =
        lights[static_cast<std::size_t>(index.wholeNumber({0.0, static_cast<double>(lights.size() - 1)}))];
    const JsonObject object(lightNode);
    Light light;
    light.kind = object.choice("type", kinds);
    const double intensity = clampedNumber(document, object, "intensity", limits::power, 1.0);
    const bool isDirectional = light.kind == LightKind::Directional;
    const double factor = isDirectional ? 1.0 : 4.0 * std::numbers::pi;
    const std::optional<JsonNode> colour = object.find("color");
    const std::vector<double> rgb =
        colour ? clampedNumbers(document, *colour, 3, limits::power) : std::vector<double>(3, 1.0);
    light.power = factor * intensity * glm::dvec3(rgb[0], rgb[1], rgb[2]);
    light.position = isDirectional ? glm::dvec3(0.0) : toWorld[3];
    light.direction = -toWorld[2];
    if (light.kind == LightKind::Spot)
        readSpot(document, object, light);
    if (!(glm::length(light.direction) > 0.0)) {
        if (light.kind != LightKind::Point) {
            document.losses().add("light without direction", [&] {
                return fmt::format("{}: {}: the light has no direction, and is left out", document.fileName(),
                                   lightNode.path.to_string());
            });
            return std::nullopt;
        }
        light.direction = {0.0, -1.0, 0.0};
    }
    light.direction = glm::normalize(light.direction);
    if (object.find("range"))
        document.losses().add("range", [&] {
            return fmt::format(
                "{}: {}/range: passed over: light falls off by the square of the distance alone",
                document.fileName(), lightNode.path.to_string());
        });
    return light;
}

} // namespace hyalite::core::gltf
