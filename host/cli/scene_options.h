// The SCENE argument and the options that override the scene file, for all commands that render.
#pragma once

#include "host/engine/prepare.h"

#include <CLI/CLI.hpp>

namespace hyalite::core {

/// Adds the SCENE argument and the options. `options` must outlive `command`.
void addSceneOptions(CLI::App &command, SceneOptions &options);

} // namespace hyalite::core
