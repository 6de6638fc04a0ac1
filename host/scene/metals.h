// Named metals of scene files.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <string_view>
#include <utility>

namespace hyalite::core {

/// A complex refractive index n + i k, at 650, 550 and 450 nm for red, green and blue.
struct Metal {
    glm::vec3 index;
    glm::vec3 extinction;
};

/// Interpolated between the lines of tables 3 and 5 of Hagemann, Gudat and Kunz, "Optical constants from the far
/// infrared to the x-ray region: Mg, Al, Cu, Ag, Au, Bi, C, and Al2O3", DESY SR-74/7, 1974 (J. Opt. Soc. Am. 65, 742).
inline constexpr std::array<std::pair<std::string_view, Metal>, 4> metalNames{{
    {"aluminium", {{1.484f, 0.998f, 0.647f}, {7.577f, 6.508f, 5.404f}}},
    {"copper", {{0.218f, 0.943f, 1.165f}, {3.637f, 2.594f, 2.390f}}},
    {"gold", {{0.477f, 0.689f, 1.766f}, {3.575f, 2.459f, 1.789f}}},
    {"silver", {{0.269f, 0.251f, 0.231f}, {4.416f, 3.566f, 2.640f}}},
}};

/// Reflectance at normal incidence.
[[nodiscard]] inline glm::vec3 normalReflectance(const glm::vec3 &index, const glm::vec3 &extinction) {
    const glm::vec3 squaredExtinction = extinction * extinction;
    const glm::vec3 below = index - 1.0f;
    const glm::vec3 above = index + 1.0f;
    return (below * below + squaredExtinction) / (above * above + squaredExtinction);
}

} // namespace hyalite::core
