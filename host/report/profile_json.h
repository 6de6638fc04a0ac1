// Profile as JSON, which a later comparison reads.
#pragma once

#include "host/report/profile.h"

#include <nlohmann/json.hpp>

namespace hyalite::core {

/// The "profileVersion" of a profile. Older ones are no baselines: 1, which said no version, was compared by
/// the name of its scene's file.
inline constexpr int profileVersion = 2;

/// All times are in milliseconds.
[[nodiscard]] nlohmann::ordered_json profileToJson(const Profile &profile);

} // namespace hyalite::core
