// Scene validation: the only check of the invariants of scene.h, for scenes from files, from code and after overrides.
#pragma once

#include "host/scene/scene.h"

#include <string>

namespace hyalite {

/// Checks the scene against limits.h: every number finite and in range, every index within its array, the view
/// direction not parallel to up. Throws Error{BadInput} "SOURCE: sphere 3: radius: found -1; allowed: ...".
void validateScene(const Scene &scene, const std::string &sourceName);

} // namespace hyalite
