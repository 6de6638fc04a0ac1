// Explanations of differences between two renders, for people and reports.
#pragma once

#include "host/cli/outliers.h"
#include "host/engine/prepare.h"
#include "host/reference/divergence.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <optional>

namespace hyalite::core {

void printDivergence(const glm::uvec2 &pixel, const std::optional<Divergence> &divergence);

/// Explains outliers with the double twin. Returns the number of those that no decision near its boundary explains.
[[nodiscard]] std::size_t explainOutliers(const PreparedScene &scene, const Pixels &outliers);

} // namespace hyalite::core
