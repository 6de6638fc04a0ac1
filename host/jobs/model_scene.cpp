#include "host/jobs/model_scene.h"

#include "host/base/error.h"
#include "host/base/standard_stream.h"
#include "host/import/assets.h"
#include "host/import/file_access.h"
#include "host/import/load.h"
#include "host/scene/framing.h"
#include "host/scene/scene_nodes.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <system_error>

namespace hyalite::core {

namespace {

constexpr int width = 640;
constexpr int height = 480;

/// Which of the scene's parts are where, with the size of the model as the unit of all but the model itself.
constexpr std::string_view text = R"({{
  "description": "A model on a floor, under a lamp and a sky. +y is up; distances are those of the model, turned and moved so that it stands at the origin. Every object of this file may have a description, which is passed over. All keys: assets/README.md of Hyalite.",
  "camera": {{
    "description": "It sees all of the model, from the front right.",
    "position": {eye},
    "target": {target},
    "horizontalFov": {fov},
    "width": {width},
    "height": {height}
  }},
  "background": [0.2, 0.23, 0.28],
  "materials": {{
    "floor": {{ "type": "diffuse", "albedo": [0.45, 0.44, 0.42] }},
    "lamp": {{
      "description": "Whatever has an emission is a light. It shines on the side of its face.",
      "type": "diffuse", "albedo": 0.8, "emission": [12, 11.2, 10]
    }}
  }},
  "meshes": [
    {{
      "description": "The model, with its own materials. A key material names one of those above instead.",
      "file": {model},
      "transform": [ {turn}{{ "translate": {move} }} ]
    }}
  ],
  "shapes": [
    {{
      "description": "The floor: a square from -1 to 1 that faces +z, made larger and turned to face up. It is a little below what stands on it.",
      "type": "quad", "material": "floor",
      "transform": [ {{ "scale": {floor} }}, {{ "rotateDegrees": [-90, 0, 0] }}, {{ "translate": [0, {below}, 0] }} ]
    }},
    {{
      "description": "The lamp: a square that faces down to the model, above, to the left of the camera.",
      "type": "quad", "material": "lamp",
      "transform": [ {{ "scale": {lamp} }}, {{ "rotateDegrees": [50, 145, 0] }}, {{ "translate": {light} }} ]
    }}
  ],
  "settings": {{
    "description": "path follows light on all its ways. More samples (spp) are less noise, and take longer.",
    "integrator": "path",
    "bvh": "sah",
    "spp": 128,
    "clamp": 4
  }}
}}
)";

/// To the power of ten that is a ten-thousandth of the size: what people read and change.
double rounded(double value, double size) {
    const double digits = std::floor(std::log10(size)) - 4.0;
    const double unit = std::pow(10.0, std::abs(digits));
    const double result = digits < 0.0 ? std::round(value * unit) / unit : std::round(value / unit) * unit;
    return result == 0.0 ? 0.0 : result; // not -0
}

std::string vectorText(const glm::dvec3 &v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

std::string vectorText(const glm::dvec3 &v, double size) {
    return vectorText({rounded(v.x, size), rounded(v.y, size), rounded(v.z, size)});
}

/// The box of a box that is turned by multiples of 90 degrees about one axis.
Bounds turned(const Bounds &bounds, const glm::dvec3 &degrees) {
    const auto turn = [&](glm::dvec3 point) {
        for (glm::length_t axis = 0; axis < 3; ++axis)
            for (double left = degrees[axis] < 0.0 ? degrees[axis] + 360.0 : degrees[axis]; left > 0.0;
                 left -= 90.0) {
                const glm::length_t from = (axis + 1) % 3;
                const glm::length_t to = (axis + 2) % 3;
                const double before = point[from];
                point[from] = -point[to];
                point[to] = before;
            }
        return point;
    };
    const glm::dvec3 a = turn(bounds.low);
    const glm::dvec3 b = turn(bounds.high);
    return {glm::min(a, b), glm::max(a, b)};
}

/// The name by which the scene finds the model.
std::string nameFrom(const std::filesystem::path &model, const std::filesystem::path &scene) {
    if (isStandardStream(model))
        throw Error(ErrorKind::Usage,
                    "found standard input as the model; allowed: a file, which the scene names");
    if (hasExtension(model, ".json"))
        throw Error(ErrorKind::Usage,
                    fmt::format("{} is a scene itself; allowed: a glTF file or a mesh", model.string()));
    std::error_code error;
    const std::filesystem::path folder = scene.parent_path().empty() ? "." : scene.parent_path();
    const std::filesystem::path real = std::filesystem::canonical(folder, error);
    if (error)
        throw Error(ErrorKind::OutputNotWritten, fmt::format("{}: {}", scene.string(), error.message()));
    const std::filesystem::path name =
        std::filesystem::weakly_canonical(model, error).lexically_relative(real);
    if (error || !FileAccess(scene, {}).allows(model))
        throw Error(
            ErrorKind::Usage,
            fmt::format("{} is not in the folder of {} or below it, where a scene may read files; write the "
                        "scene beside the model",
                        model.string(), scene.string()));
    return name.string();
}

} // namespace

std::string sceneAround(const std::filesystem::path &model, const std::filesystem::path &scene,
                        const glm::dvec3 &turnDegrees) {
    const std::string name = nameFrom(model, scene);
    const LoadedScene loaded = loadScene(model.string(), {});
    Bounds bounds = sceneBounds(loaded.scene).all;
    requireFramed(bounds, model.string());
    bounds = turned({bounds.low + loaded.scene.origin, bounds.high + loaded.scene.origin}, turnDegrees);
    const glm::dvec3 move(-bounds.centre().x, -bounds.low.y, -bounds.centre().z);
    const Bounds standing{bounds.low + move, bounds.high + move};
    const double size = glm::length(standing.high - standing.low);
    const Camera camera = frameCamera(standing, width, height, defaultFovDegrees);
    const glm::dvec3 light = standing.centre() + 2.0 * size * directionOf({-35.0, 50.0});
    const bool isTurned = turnDegrees != glm::dvec3(0.0);
    return fmt::format(
        text, fmt::arg("eye", vectorText(camera.position, size)),
        fmt::arg("target", vectorText(standing.centre(), size)), fmt::arg("fov", defaultFovDegrees),
        fmt::arg("width", width), fmt::arg("height", height), fmt::arg("model", nlohmann::json(name).dump()),
        fmt::arg("turn", isTurned ? fmt::format("{{ \"rotateDegrees\": {} }}, ", vectorText(turnDegrees))
                                  : std::string()),
        fmt::arg("move", vectorText(move)), fmt::arg("floor", rounded(20.0 * size, size)),
        fmt::arg("below", rounded(-1e-4 * size, 1e-3 * size)), fmt::arg("lamp", rounded(0.6 * size, size)),
        fmt::arg("light", vectorText(light, size)));
}

} // namespace hyalite::core
