// Options of `diff`.
#pragma once

#include "host/cli/failure.h"
#include "host/film/welch_test.h"
#include "host/image/image.h"

#include <optional>
#include <string>

namespace hyalite::core {

struct DiffOptions {
    std::string reference;
    std::string test;
    std::string mask;
    std::string heatMap;
    std::string report;
    std::string html;
    std::string junit;
    bool isStatistical = false;
    WelchOptions welch;
    double outlierThreshold = 0.0;
    std::optional<double> minPsnr;
    std::optional<double> minSsim;
    std::optional<double> maxFlip;
    std::optional<double> maxDifference;
    std::optional<double> maxOutliers;
};

/// Throws Error{BadInput}.
void requireSameSize(const Image &a, const std::string &pathA, const Image &b, const std::string &pathB);

/// The verdict on two files as JUnit XML. No failure: they passed.
[[nodiscard]] std::string diffToJunit(const DiffOptions &options, double seconds, const std::string &failure);

/// Compares two images as numbers, against bounds.
[[nodiscard]] ExitCode runDiff(const DiffOptions &options, const std::string &commandLine);

/// Compares two renders as estimates of one picture.
[[nodiscard]] ExitCode runStatisticalDiff(const DiffOptions &options, const std::string &commandLine);

} // namespace hyalite::core
