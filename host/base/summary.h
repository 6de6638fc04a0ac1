// Summary statistics of repeated measurements.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hyalite::core {

/// The quantile `share`, in [0, 1], of `values`, by linear interpolation. `values` is not empty; its order does not
/// matter.
[[nodiscard]] double quantile(std::span<const double> values, double share);

struct Summary {
    std::size_t count = 0; ///< if 0, all below are 0
    double total = 0.0;
    double min = 0.0;
    double median = 0.0;
    double p95 = 0.0; ///< 95 % of the values lie below
    double max = 0.0;
};

[[nodiscard]] Summary summarise(std::span<const double> values);

/// Half the interquartile range, relative to the median: the usual deviation of a repeat. 0 for fewer than two values,
/// and for a median of 0.
[[nodiscard]] double relativeSpread(std::span<const double> values);

} // namespace hyalite::core
