#include "host/base/summary.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace hyalite::core {

double quantile(std::span<const double> values, double share) {
    assert(!values.empty() && share >= 0.0 && share <= 1.0);
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const double position = share * static_cast<double>(sorted.size() - 1);
    const std::size_t below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (sorted[above] - sorted[below]) * (position - static_cast<double>(below));
}

Summary summarise(std::span<const double> values) {
    if (values.empty())
        return {};
    return {values.size(),          std::accumulate(values.begin(), values.end(), 0.0),
            quantile(values, 0.0),  quantile(values, 0.5),
            quantile(values, 0.95), quantile(values, 1.0)};
}

double relativeSpread(std::span<const double> values) {
    if (values.size() < 2)
        return 0.0;
    const double median = quantile(values, 0.5);
    if (median <= 0.0)
        return 0.0;
    return (quantile(values, 0.75) - quantile(values, 0.25)) / 2.0 / median;
}

} // namespace hyalite::core
