// Loading: from a SCENE argument to a validated scene.
#pragma once

#include "host/import/scene_json.h"

#include <filesystem>
#include <span>
#include <string>

namespace hyalite {

/// Loads a scene file, a bare mesh (framed and lit) or a shipped scene by its name, and validates it. A scene file may
/// name files in its own folder, in the assets and in `allowedPaths`. Throws Error{BadInput}.
[[nodiscard]] LoadedScene loadScene(const std::string &argument, const LoadEvents &events = {},
                                    std::span<const std::filesystem::path> allowedPaths = {});

} // namespace hyalite
