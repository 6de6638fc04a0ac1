// A comparison with a baseline, as JSON for a page.
#pragma once

#include "host/report/baseline.h"

namespace hyalite::core {

/// What judges a comparison, and its result.
struct BaselineVerdict {
    BaselineComparison comparison;
    nlohmann::json baseline; ///< its report
    double maxRegression = 0.0;
    Gate gate = Gate::All;
};

/// Times that cannot be compared, as one side has none or one frame only, have no ratio, or no noise.
[[nodiscard]] nlohmann::ordered_json comparisonToJson(const BaselineVerdict &verdict);

} // namespace hyalite::core
