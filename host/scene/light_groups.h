// Light groups: emitters by name, each with a layer of light of its own.
#pragma once

#include "host/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core {

/// Of emitters that a scene gives no group.
inline constexpr std::string_view defaultLightGroup = "default";

/// 1 to 32 letters, digits, underscores and hyphens of ASCII: a part of a layer's name.
[[nodiscard]] bool isLightGroupName(std::string_view name);

/// The groups of what shines, in the order of lights, materials, and the environment or the background.
[[nodiscard]] std::vector<std::string> lightGroupsOf(const Scene &scene);

/// The number of the group, from 0 on; 0 of one that is not among them: nothing in it shines.
[[nodiscard]] std::uint32_t numberOfGroup(const std::vector<std::string> &groups, const std::string &name);

} // namespace hyalite::core
