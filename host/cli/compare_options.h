// Options of `compare`.
#pragma once

#include "host/cli/failure.h"
#include "host/film/welch_test.h"
#include "host/lab/comparison_index.h"
#include "host/lab/comparison_run.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

struct CompareOptions {
    SceneOptions scene;
    std::vector<std::string> moreScenes; ///< compared by the same options
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

/// The outcome of two renders of a scene, and how an index of several shows it.
struct ComparedScene {
    TestSuite suite;
    IndexedComparison row;
};

/// Two renders with the same samples, pixel by pixel. The requested files are written, but for that of JUnit.
[[nodiscard]] ComparedScene compareScene(const CompareOptions &options, const std::string &commandLine);

/// The same of all scenes, one after another.
[[nodiscard]] ExitCode runCompare(const CompareOptions &options, const std::string &commandLine);

/// Two renders with different seeds, as estimates of one picture.
[[nodiscard]] ExitCode runStatisticalCompare(const CompareOptions &options, const std::string &commandLine);

} // namespace hyalite::core
