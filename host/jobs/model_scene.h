// A scene file around a model: a floor, a lamp, a sky, and a camera that sees it.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace hyalite::core {

/// The rotations, by `rotateDegrees` of scene files, that bring an axis of a model to +y.
inline constexpr std::array<std::pair<std::string_view, glm::dvec3>, 6> upTurns{{{"y", {0.0, 0.0, 0.0}},
                                                                                 {"z", {-90.0, 0.0, 0.0}},
                                                                                 {"x", {0.0, 0.0, 90.0}},
                                                                                 {"-y", {180.0, 0.0, 0.0}},
                                                                                 {"-z", {90.0, 0.0, 0.0}},
                                                                                 {"-x", {0.0, 0.0, -90.0}}}};

/// The text of a scene that will be at `scene`, around the model, a glTF file or a mesh, which stands on the floor at
/// the origin after the turn. Throws Error{Usage} for a model that a scene there may not read, or that is a scene of
/// ours, and Error{BadInput} for one that cannot be read, or is too small or too large.
[[nodiscard]] std::string sceneAround(const std::filesystem::path &model, const std::filesystem::path &scene,
                                      const glm::dvec3 &turnDegrees);

} // namespace hyalite::core
