// Every dispatch of a profile as a line of a CSV file (RFC 4180), for tables and plots of others.
#pragma once

#include "host/report/profile.h"

#include <string>

namespace hyalite {

/// A line of column names, then a line for each dispatch of each frame, measured or not. Times are in milliseconds, and
/// begin at the beginning of the first frame. The device's are empty where it has no timestamps.
[[nodiscard]] std::string profileCsv(const Profile &profile);

} // namespace hyalite
