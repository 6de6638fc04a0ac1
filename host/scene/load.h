// From the SCENE argument of a command to a validated scene.
#pragma once

#include "host/scene/scene_json.h"

#include <string>

namespace hyalite {

/// Loads a scene file, a bare mesh (framed and lit) or a shipped scene by its name, and validates it. Throws
/// Error{BadInput}.
[[nodiscard]] LoadedScene loadScene(const std::string &argument, const OnReading &onReading = {});

} // namespace hyalite
