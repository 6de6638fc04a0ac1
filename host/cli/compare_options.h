// Options of `compare`.
#pragma once

#include "host/cli/failure.h"
#include "host/film/welch_test.h"
#include "host/lab/comparison_run.h"

#include <cstdint>
#include <optional>
#include <string>

namespace hyalite::core {

struct CompareOptions {
    SceneOptions scene;
    ComparisonRequest comparison;
    std::string tolerance = "0";
    double maxOutliers = 0.0;
    std::string heatMap;
    std::string report;
    std::string html;
    std::string junit;
    bool isStatistical = false;
    WelchOptions welch;
    std::optional<std::uint32_t> againstSeed;
    bool isQuiet = false;
};

void printRenderers(const PreparedScene &scene, const ComparisonRun &run);

/// Two renders with the same samples, pixel by pixel.
[[nodiscard]] ExitCode runCompare(const CompareOptions &options, const std::string &commandLine);

/// Two renders with different seeds, as estimates of one picture.
[[nodiscard]] ExitCode runStatisticalCompare(const CompareOptions &options, const std::string &commandLine);

} // namespace hyalite::core
