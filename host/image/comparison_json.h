// A comparison as JSON, for the reports of commands.
#pragma once

#include "host/image/comparison.h"

#include <nlohmann/json.hpp>

namespace hyalite {

/// All metrics. The images are those that were compared; their values at the worst pixel are told. What is not
/// available, and what JSON has no number for (an infinite PSNR), becomes null when it is written.
[[nodiscard]] nlohmann::ordered_json comparisonToJson(const ImageComparison &comparison,
                                                      const Image &reference, const Image &test);

} // namespace hyalite
