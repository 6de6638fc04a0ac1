// Comparison of two renderers on one scene.
#pragma once

#include "host/engine/open_backends.h"
#include "host/reference/divergence.h"

#include <memory>
#include <optional>
#include <string>

namespace hyalite::core {

struct ComparisonRequest {
    std::string device = "auto";
    std::string against = "cpu";
    int threadCount = 0;         ///< 0: all
    DeviceOptions deviceOptions; ///< of both, unless the second is the reference renderer
};

struct ComparisonRun {
    std::unique_ptr<Backend> first;
    std::unique_ptr<Backend> second;
};

[[nodiscard]] ComparisonRun openComparison(const ComparisonRequest &request, const PreparedScene &scene,
                                           Observer &observer);

/// Retraces a pixel of the whole image on both sides, sample by sample, until a step differs.
[[nodiscard]] std::optional<Divergence>
findFirstDivergence(Backend &first, Backend &second, const PreparedScene &scene, const glm::uvec2 &pixel);

/// The beginning of a report on two renders.
[[nodiscard]] nlohmann::ordered_json comparisonRunToJson(const ComparisonRun &run, const PreparedScene &scene,
                                                         const std::string &commandLine);

} // namespace hyalite::core
