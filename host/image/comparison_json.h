// An image comparison as JSON, for reports.
#pragma once

#include "host/image/comparison.h"

#include <nlohmann/json.hpp>

namespace hyalite::core {

/// All metrics, and the values of the compared images at the worst pixel. Values that are not available, or that JSON
/// cannot express (an infinite PSNR), become null. "alpha" is there if an image has it; "identical" covers it.
[[nodiscard]] nlohmann::ordered_json comparisonToJson(const ImageComparison &comparison,
                                                      const Image &reference, const Image &test);

} // namespace hyalite::core
