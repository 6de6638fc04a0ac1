// Photometric profiles: the intensity of a lamp by direction, as it was measured (IESNA LM-63, type C).
//
// A direction has two angles: gamma, from the light's direction, and C, around it. C is 0 in the half plane of the
// light's `c0`, and grows counter-clockwise for who looks against the direction of the light: 90 degrees is at
// cross(c0, direction). Between the angles of the profile, intensity is bilinear in both.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace hyalite::core {

struct LightProfile {
    std::string name; ///< for messages: the file it came from
    /// Degrees in [0, 180], ascending, two at least. It is dark before and behind them.
    std::vector<double> gammas;
    /// Degrees of C, ascending from 0 to 360, both included; or only one: the lamp is the same all around.
    std::vector<double> planes;
    /// Of each plane in turn, at each gamma: intensity as a share of the greatest one, in [0, 1].
    std::vector<float> shares;
    double candela = 1.0; ///< the greatest intensity
};

/// Angles to the light's direction, in degrees, between which a profile has light.
struct LitAngles {
    double low = 0.0;
    double high = 0.0; ///< not above `low`: there is none
};

[[nodiscard]] LitAngles litAnglesOf(const LightProfile &profile);

/// The mean share over all directions of those within `angleDegrees` of the light's direction; the others count as dark.
/// It is 0 only if all of them are.
[[nodiscard]] double meanShare(const LightProfile &profile, double angleDegrees = 180.0);

/// Whether the directions, of any length but zero, have one axis.
[[nodiscard]] bool isParallel(const glm::dvec3 &a, const glm::dvec3 &b);

/// Where C is 0 for a light whose file does not say so: +x, or +z for one that shines along x.
[[nodiscard]] glm::dvec3 defaultC0(const glm::dvec3 &direction);

/// Luminous flux, in lumens.
[[nodiscard]] double lumensOf(const LightProfile &profile);

} // namespace hyalite::core
