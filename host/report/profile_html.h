// Profile as an HTML page: profile.html with the report in it. It needs no network; its script shows the figures.
#pragma once

#include "host/report/baseline_json.h"
#include "host/report/profile.h"

#include <cstddef>
#include <span>
#include <string>

namespace hyalite::core {

/// The page holds the report (profile_json.h), and in it what follows, in base64. `png`, the encoded image, becomes
/// "picture"; `heatMapPng`, its work, if it was counted, "heatMap". `comparison`, with a baseline, or
/// null, becomes "comparison" (baseline_json.h), and the report of the baseline "baseline".
[[nodiscard]] std::string profileHtml(const Profile &profile, std::span<const std::byte> png,
                                      std::span<const std::byte> heatMapPng = {},
                                      const BaselineVerdict *comparison = nullptr);

} // namespace hyalite::core
