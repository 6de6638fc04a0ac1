// Profile as CSV (RFC 4180): a line for each dispatch.
#pragma once

#include "host/report/profile.h"

#include <string>

namespace hyalite::core {

/// A line of column names, then a line for each dispatch of each frame, measured or not. Times are in milliseconds
/// since the first frame began. Device times are empty if the device has no timestamps.
[[nodiscard]] std::string profileCsv(const Profile &profile);

} // namespace hyalite::core
