// Profile as an HTML page: profile.html with the report in it. It needs no network; its script shows the figures.
#pragma once

#include "host/report/profile.h"

#include <cstddef>
#include <span>
#include <string>

namespace hyalite::core {

/// `png` is the encoded image, and `heatMapPng` that of its work, if it was counted: they become "picture" and
/// "heatMap" of the report (profile_json.h).
[[nodiscard]] std::string profileHtml(const Profile &profile, std::span<const std::byte> png,
                                      std::span<const std::byte> heatMapPng = {});

} // namespace hyalite::core
