// Loading: from a SCENE argument to a validated scene.
#pragma once

#include "host/import/loaded_scene.h"
#include "host/import/scene_document.h"

#include <string>

namespace hyalite::core {

/// Loads a scene file of any format, a bare mesh (framed and lit) or a shipped scene by its name, and validates it. A
/// scene file may name files in its own folder, in the assets and in `options.allowedPaths`. Shipped scenes are looked
/// for as assets.h says. Throws Error{BadInput}, and Error{Usage} for choices that the file does not offer.
[[nodiscard]] LoadedScene loadScene(const std::string &argument, const LoadOptions &options = {});

/// The same for a scene in memory.
[[nodiscard]] LoadedScene loadScene(const SceneDocument &document, const LoadOptions &options = {});

} // namespace hyalite::core
