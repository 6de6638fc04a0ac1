// Draws of single values: by table rows, with the ends of ranges, zeros and tiny numbers more often than by chance.
#pragma once

#include "host/scene/settings_table.h"
#include "tests/fixtures/geometry_fixture.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hyalite::core::testing {

/// Two streams: one decides what there is, and so what kernels leave out; the other one draws the numbers.
class Draws {
  public:
    Draws(std::uint64_t kind, std::uint64_t variant) : kind_(kind), numbers_(kind * 1000003u + variant) {
        isExtreme = chance(0.1);
    }

    bool isExtreme; ///< numbers come from all of their ranges

    [[nodiscard]] double share() { return kind_.uniform(); }
    [[nodiscard]] bool chance(double probability) { return share() < probability; }
    [[nodiscard]] int whole(int low, int high) {
        return low + static_cast<int>(kind_.below(static_cast<std::size_t>(high - low + 1)));
    }
    [[nodiscard]] int level() { return static_cast<int>(numbers_.below(256)); }
    /// Of three decimal digits: files are short, and the same everywhere.
    [[nodiscard]] double uniform(double low, double high) { return rounded(numbers_.uniform(low, high)); }
    [[nodiscard]] nlohmann::json vector(double half) {
        return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
    }
    template <class Values> [[nodiscard]] const auto &oneOf(const Values &values) {
        return *std::next(std::begin(values), whole(0, static_cast<int>(std::size(values)) - 1));
    }

    /// Of a range: an end, next to its lower end, or somewhere between, where ranges are wide near 0.
    [[nodiscard]] double number(const Interval &range) {
        constexpr double usual = 4.0;
        const bool isWide = range.high - range.low > 1000.0;
        const double low = std::max(range.low, isWide ? -usual : range.low);
        const double high = std::min(range.high, isWide ? usual : range.high);
        const double chosen = share();
        if (chosen < 0.12)
            return range.lowIncluded ? isWide && !isExtreme ? low : range.low : smallestAbove(range);
        if (chosen < 0.24 && range.highIncluded)
            return isWide && !isExtreme ? high : range.high;
        if (chosen < 0.3)
            return smallestAbove(range);
        if (isExtreme && isWide && chosen < 0.5)
            return std::clamp(std::ldexp(chance(0.5) && range.low < 0.0 ? -1.0 : 1.0, whole(-60, 90)), low,
                              range.high);
        const double inside = uniform(low, high); // rounded, maybe to an end
        return range.contains(inside) ? inside : (low + high) / 2.0;
    }

    /// One number for all channels, or three.
    [[nodiscard]] nlohmann::json colour(const Interval &range) {
        if (chance(0.5))
            return number(range);
        return {number(range), number(range), number(range)};
    }

  private:
    [[nodiscard]] static double rounded(double value) {
        return value == 0.0 ? 0.0 : std::stod(fmt::format("{:.3g}", value));
    }
    [[nodiscard]] double smallestAbove(const Interval &range) const {
        return range.low + (isExtreme && range.low == 0.0 ? 1e-12 : 1e-4);
    }

    Random kind_;
    Random numbers_;
};

} // namespace hyalite::core::testing
