// Profile as JSON, which a later comparison reads.
#pragma once

#include "host/report/profile.h"

#include <nlohmann/json.hpp>

namespace hyalite {

/// All times are in milliseconds.
[[nodiscard]] nlohmann::ordered_json profileToJson(const Profile &profile);

} // namespace hyalite
