// Profile as tables for people.
#pragma once

#include "host/report/profile.h"

#include <string>

namespace hyalite::core {

/// Stages, kernels and rays, at most 110 columns wide, with a line feed at the end.
[[nodiscard]] std::string profileTable(const Profile &profile);

} // namespace hyalite::core
