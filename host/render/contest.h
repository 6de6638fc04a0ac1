// Two renderers on one scene, to be compared.
#pragma once

#include "host/reference/divergence.h"
#include "host/render/backend.h"

#include <memory>
#include <optional>
#include <string>

namespace hyalite {

struct ContestRequest {
    std::string device = "auto";
    std::string against = "cpu";
    int threadCount = 0;         ///< 0: all
    DeviceOptions deviceOptions; ///< of both, but for the reference renderer as the second
};

struct Contestants {
    std::unique_ptr<Backend> first;
    std::unique_ptr<Backend> second;
};

[[nodiscard]] Contestants openContestants(const ContestRequest &request, const PreparedScene &scene);

/// Retraces a pixel of the whole image on both sides, sample by sample, until a step differs.
[[nodiscard]] std::optional<Divergence>
findFirstDivergence(const Contestants &contestants, const PreparedScene &scene, const glm::uvec2 &pixel);

/// What a report of two renders begins with.
[[nodiscard]] nlohmann::ordered_json contestToJson(const Contestants &contestants, const PreparedScene &scene,
                                                   const std::string &commandLine);

} // namespace hyalite
