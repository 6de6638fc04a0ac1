// --statistical, for `compare` and `diff`: a test of two renders as estimates of one picture.
#pragma once

#include "host/film/welch_test.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>

namespace hyalite::core {

/// Adds --significance. `options` must outlive the command.
CLI::Option *addSignificanceOption(CLI::App &command, WelchOptions &options);

/// Reads colours, "variance" and, if present, "samples" of an EXR file. Throws Error{BadInput} for other files.
[[nodiscard]] Estimate readEstimate(const std::string &path);

/// Tests, prints the result, and returns it. Throws Error{BadInput} if no pixel can be tested; `names` is for the
/// message.
[[nodiscard]] WelchResult testAndPrint(const Estimate &a, const Estimate &b, const WelchOptions &options,
                                       const std::string &names);

/// Why the test fails, or an empty text.
[[nodiscard]] std::string failureOf(const WelchResult &result);

/// JSON for reports.
[[nodiscard]] nlohmann::ordered_json welchToJson(const WelchResult &result, const WelchOptions &options);

} // namespace hyalite::core
