// A scene's summary as JSON. The keys are listed in host/cli/README.md.
#pragma once

#include "host/lab/coverage.h"
#include "host/lab/scene_summary.h"
#include "host/lab/tree_check.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace hyalite::core {

/// Of the document. A new key leaves it; one that changes or goes raises it.
inline constexpr int inspectVersion = 2;

/// By the keys of scene files.
[[nodiscard]] nlohmann::ordered_json cameraToJson(const Camera &camera);
[[nodiscard]] nlohmann::ordered_json lightToJson(const Light &light);

/// With what was measured beside it.
[[nodiscard]] nlohmann::ordered_json sceneToJson(const SceneSummary &summary,
                                                 const std::optional<Coverage> &coverage,
                                                 const std::optional<TreeCheck> &check,
                                                 const std::string &commandLine);

} // namespace hyalite::core
