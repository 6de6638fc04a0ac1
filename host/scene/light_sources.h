// Light sources of a scene, by kind.
#pragma once

#include "host/scene/scene.h"

namespace hyalite {

struct LightSources {
    bool hasLights = false;   ///< without size, with power
    bool hasEmitters = false; ///< surfaces whose material shines
    bool hasEnvironment = false;
    bool hasBackground = false; ///< that is not black
};

/// Materials that nothing wears do not count.
[[nodiscard]] LightSources lightSourcesOf(const Scene &scene);

/// Whether there is anything to light.
[[nodiscard]] bool hasSurfaces(const Scene &scene);

} // namespace hyalite
