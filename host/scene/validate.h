// Scene validation: the only check of the invariants of scene.h, for scenes from files, from code and after overrides.
#pragma once

#include "host/scene/camera_path.h"
#include "host/scene/scene.h"
#include "host/scene/settings.h"

#include <string>

namespace hyalite::core {

/// Checks the scene against limits.h: every number finite and in range, every index within its array, the view
/// direction not parallel to up. Throws Error{BadInput} "SOURCE: sphere 3: radius: found -1; allowed: ...".
void validateScene(const Scene &scene, const std::string &sourceName);

/// Checks the settings against settings_table.h, and that they can render `scene`. Throws likewise.
void validateSettings(const RenderSettings &settings, const Scene &scene, const std::string &sourceName);

/// Checks a camera of the scene alone. Throws likewise.
void validateCamera(const Camera &camera, const std::string &sourceName);

/// Throws Error{BadInput} for the first pose in which the camera is not valid, and names its frame.
void validateCameraPath(const CameraPath &path, const Camera &camera, const std::string &sourceName);

} // namespace hyalite::core
