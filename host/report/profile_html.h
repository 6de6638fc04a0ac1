// Profile as an HTML page: profile.html with the report in it. It needs no network; its script shows the figures.
#pragma once

#include "host/report/baseline_json.h"
#include "host/report/profile.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core {

/// PNGs by PathStage, each empty if it was not drawn.
using StagePictures = std::array<std::vector<std::byte>, pathStageNames.size()>;

/// The page holds the report (profile_json.h), and in it what follows, in base64. `png`, the encoded image, becomes
/// "picture"; `heatMapPng`, its work, if it was counted, "heatMap"; `stagePngs`, the tests of each pixel by stages,
/// "stagePictures". `comparison`, with a baseline, or null, becomes "comparison" (baseline_json.h), and the report of
/// the baseline "baseline".
[[nodiscard]] std::string profileHtml(const Profile &profile, std::span<const std::byte> png,
                                      std::span<const std::byte> heatMapPng = {},
                                      const StagePictures &stagePngs = {},
                                      const BaselineVerdict *comparison = nullptr);

} // namespace hyalite::core
