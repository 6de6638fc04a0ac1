// Light sources of a scene, by kind.
#pragma once

#include "host/scene/integrators.h"
#include "host/scene/scene.h"

#include <optional>
#include <string>

namespace hyalite::core {

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

/// A warning about light of the scene that the integrator does not see, or that there is none at all. Empty where
/// all is well, and for integrators that show something else than light.
[[nodiscard]] std::optional<std::string> diagnoseLight(const Scene &scene, Integrator integrator);

} // namespace hyalite::core
