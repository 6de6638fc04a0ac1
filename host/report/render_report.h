// What a render did and how long it took, as JSON.
#pragma once

#include "host/report/ray_counts.h"
#include "host/report/render_timing.h"
#include "host/scene/scene.h"

#include <nlohmann/json.hpp>

#include <string>

namespace hyalite {

struct RenderReport {
    std::string commandLine;
    std::string scene; ///< path of the file
    std::string output;
    std::string deviceName;
    std::string deviceDriver;
    std::string arithmetic; ///< which / and sqrt ran
    int width = 0;          ///< of the output, pixels
    int height = 0;
    RenderSettings settings;
    std::size_t triangleCount = 0;
    RayCounts rays;
    double loadSeconds = 0.0;
    double buildSeconds = 0.0;
    RenderTiming timing;
    double writeSeconds = 0.0;
    double totalSeconds = 0.0;
};

/// As all reports write them.
[[nodiscard]] nlohmann::ordered_json settingsToJson(const RenderSettings &settings);
[[nodiscard]] nlohmann::ordered_json raysToJson(const RayCounts &rays);

[[nodiscard]] std::string formatReport(const RenderReport &report);

} // namespace hyalite
