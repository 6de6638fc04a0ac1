#include "host/import/gltf/lights.h"

#include "host/import/gltf/uri.h"
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

glm::dvec3 colourOf(const Document &document, const JsonObject &object, const Interval &allowed) {
    const std::optional<JsonNode> colour = object.find("color");
    if (!colour)
        return glm::dvec3(1.0);
    const std::vector<double> rgb = clampedNumbers(document, *colour, 3, allowed);
    return {rgb[0], rgb[1], rgb[2]};
}

void addLossOfDirection(const Document &document, const JsonNode &light) {
    document.losses().add("light without direction", [&] {
        return fmt::format("{}: {}: the light has no direction, and is left out", document.fileName(),
                           light.path.to_string());
    });
}

} // namespace

JsonNode lightOf(const Document &document, const JsonObject &use, std::string_view name) {
    const JsonNode index = use.at("light");
    const std::optional<JsonObject> extension = extensionOf(document.top(), name);
    const Elements lights = extension ? elementsOf(*extension, "lights") : Elements();
    if (lights.empty())
        index.refuse(fmt::format("an index of /extensions/{}/lights, of which there are none", name));
    return lights[static_cast<std::size_t>(index.wholeNumber({0.0, static_cast<double>(lights.size() - 1)}))];
}

std::optional<Light> readLight(const Document &document, const JsonObject &node,
                               const glm::dmat4x3 &toWorld) {
    const std::optional<JsonObject> use = extensionOf(node, "KHR_lights_punctual");
    if (!use)
        return std::nullopt;
    const JsonNode lightNode = lightOf(document, *use, "KHR_lights_punctual");
    const JsonObject object(lightNode);
    Light light;
    light.kind = object.choice("type", kinds);
    const double intensity = clampedNumber(document, object, "intensity", limits::power, 1.0);
    const bool isDirectional = light.kind == LightKind::Directional;
    const double factor = isDirectional ? 1.0 : 4.0 * std::numbers::pi;
    light.power = factor * intensity * colourOf(document, object, limits::power);
    light.position = isDirectional ? glm::dvec3(0.0) : toWorld[3];
    light.direction = -toWorld[2];
    if (light.kind == LightKind::Spot)
        readSpot(document, object, light);
    if (!(glm::length(light.direction) > 0.0)) {
        if (light.kind != LightKind::Point) {
            addLossOfDirection(document, lightNode);
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

std::optional<Light> ProfiledLights::read(const JsonObject &node, const glm::dmat4x3 &toWorld) {
    constexpr std::string_view name = "EXT_lights_ies";
    const Document &document = buffers_.document();
    const std::optional<JsonObject> use = extensionOf(node, name);
    if (!use)
        return std::nullopt;
    const JsonNode lightNode = lightOf(document, *use, name);
    Light light;
    light.position = toWorld[3];
    light.direction = -toWorld[2];
    if (!(glm::length(light.direction) > 0.0)) {
        addLossOfDirection(document, lightNode);
        return std::nullopt;
    }
    light.direction = glm::normalize(light.direction);
    const bool isTurned = glm::length(toWorld[0]) > 0.0 && !isParallel(toWorld[0], light.direction);
    light.c0 = isTurned ? glm::normalize(toWorld[0]) : defaultC0(light.direction);
    const std::uint32_t profile = profileOf(lightNode);
    light.profile = profile;
    const double multiplier = clampedNumber(document, *use, "multiplier", limits::power, 1.0);
    const double power = 4.0 * std::numbers::pi * library_.at(profile).candela * multiplier;
    light.power = std::min(power, limits::power.high) * colourOf(document, *use, limits::fraction);
    return light;
}

std::uint32_t ProfiledLights::profileOf(const JsonNode &light) {
    const std::string name = fmt::format("{}#{}", buffers_.document().fileName(), light.path.to_string());
    const auto known = profiles_.find(name);
    return known != profiles_.end() ? known->second
                                    : profiles_.emplace(name, load(light, name)).first->second;
}

std::uint32_t ProfiledLights::load(const JsonNode &light, const std::string &name) {
    const JsonObject object(light);
    if (const std::optional<JsonNode> view = object.find("bufferView"))
        return library_.load(
            InputFile(name, buffers_.view(buffers_.document().reference(*view, "bufferViews")).bytes),
            warnings_);
    const std::optional<JsonNode> uri = object.find("uri");
    if (!uri)
        light.fail("a light with neither \"uri\" nor \"bufferView\"; allowed: one of the two");
    if (const std::optional<std::vector<std::byte>> data = dataOf(*uri))
        return library_.load(InputFile(name, *data), warnings_);
    return library_.load(access_.resolve(*uri, fileNameOf(*uri)), warnings_);
}

} // namespace hyalite::core::gltf
