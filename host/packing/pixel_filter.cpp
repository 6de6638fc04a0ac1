#include "host/packing/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyalite::core {

namespace {

/// The quantile `share` of the filter, in pixels from its centre, by bisection to the limit of double precision.
double filterQuantile(double share) {
    double low = -filterRadius;
    double high = filterRadius;
    for (;;) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
            return middle;
        (filterShareBelow(middle) < share ? low : high) = middle;
    }
}

} // namespace

double filterShareBelow(double x) {
    constexpr double terms[] = {0.35875, 0.48829, 0.14128, 0.01168};
    const double t = std::clamp(0.5 + 0.5 * x / filterRadius, 0.0, 1.0);
    const double turn = 2.0 * std::numbers::pi;
    const double integral = terms[0] * t - terms[1] * std::sin(turn * t) / turn +
                            terms[2] * std::sin(2.0 * turn * t) / (2.0 * turn) -
                            terms[3] * std::sin(3.0 * turn * t) / (3.0 * turn);
    return std::clamp(integral / terms[0], 0.0, 1.0);
}

void packFilter(PackedScene &packed) {
    packed.frame.filterTexels = static_cast<std::uint32_t>(packed.lookups.size());
    double begin = -filterRadius;
    for (std::uint32_t cell = 0; cell < layout::filterCellCount; ++cell) {
        const double end = cell + 1 == layout::filterCellCount
                               ? filterRadius
                               : filterQuantile((cell + 1.0) / layout::filterCellCount);
        packed.lookups.push_back(
            {glm::vec3(static_cast<float>(0.5 + begin), static_cast<float>(end - begin), 0.0f), 0});
        begin = end;
    }
}

} // namespace hyalite::core
