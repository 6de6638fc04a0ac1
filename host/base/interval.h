// Intervals of numbers, and their words in messages.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <string>

namespace hyalite::core {

/// An interval. No interval contains NaN.
struct Interval {
    double low;
    double high;
    bool lowIncluded = true;
    bool highIncluded = true;

    /// The ends are first rounded to T: what was read in range as a double stays in range as a float.
    template <std::floating_point T> [[nodiscard]] constexpr bool contains(T value) const {
        const T lowest = static_cast<T>(low);
        const T highest = static_cast<T>(high);
        return (lowIncluded ? value >= lowest : value > lowest) &&
               (highIncluded ? value <= highest : value < highest);
    }

    /// The number of the interval that `value` stands for: itself, or an end that it is beyond by what adding and
    /// rounding floats leaves, 2^-21 of the end or of 1. Where there is none, `value`.
    [[nodiscard]] double rounded(double value) const {
        constexpr double rounding = 1.0 / (1 << 21);
        const auto isNear = [&](double end) {
            return std::abs(value - end) <= rounding * std::max(1.0, std::abs(end)) &&
                   std::abs(value - end) <= rounding * (high - low);
        };
        if (value < low && lowIncluded && isNear(low))
            return low;
        return value > high && highIncluded && isNear(high) ? high : value;
    }

    /// In words: "from 0 to 1", "more than 0 and less than 180".
    [[nodiscard]] std::string text() const {
        if (lowIncluded && highIncluded)
            return fmt::format("from {:.10g} to {:.10g}", low, high);
        return fmt::format("{} {:.10g} and {} {:.10g}", lowIncluded ? "at least" : "more than", low,
                           highIncluded ? "at most" : "less than", high);
    }
};

} // namespace hyalite::core
