// What many measurements of the same thing come to.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hyalite {

/// The value below which `share` of the values lie, by linear interpolation between the two that are next to it.
/// `values` is not empty, in any order; `share` is in [0, 1].
[[nodiscard]] double quantile(std::span<const double> values, double share);

struct Summary {
    std::size_t count = 0; ///< all below are 0 where this is
    double total = 0.0;
    double min = 0.0;
    double median = 0.0;
    double p95 = 0.0; ///< 95 % of the values lie below
    double max = 0.0;
};

[[nodiscard]] Summary summarise(std::span<const double> values);

/// Half of the distance between the quartiles, as a share of the median: how far a repeat usually lies off. 0 for less
/// than two values, which tell nothing, and where the median is 0.
[[nodiscard]] double relativeSpread(std::span<const double> values);

} // namespace hyalite
