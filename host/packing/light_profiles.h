// Profiles of lights as lookup rows, and how much of their light goes where.
#pragma once

#include "host/packing/packed_scene.h"

namespace hyalite::core {

/// Appends the profiles of the lights to packed.lookups, of which they are the last rows, in place of those that are
/// there, and says in packed.frame where they begin. Without any the frame says 0.
void packProfiles(const Scene &scene, PackedScene &packed);

/// The light of a light with a profile.
struct ProfiledLight {
    double meanShare = 0.0; ///< of its greatest intensity, over all directions
    /// All of it leaves within an angle of this direction.
    glm::vec3 axis{0.0f, 1.0f, 0.0f};
    float cosine = -1.0f; ///< of that angle
};

[[nodiscard]] ProfiledLight profiledLight(const Scene &scene, const Light &light);

} // namespace hyalite::core
