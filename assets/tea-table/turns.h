// Sines and cosines that are the same on every machine: the standard library's differ in their last bits.
#pragma once

#include <array>
#include <cmath>

namespace tea_table {

/// The sine of an angle in turns, by its Taylor series over an eighth of a turn; the error is below 1e-15.
inline double sinTurns(double turns) {
    const auto series = [](double first, int from, double square) {
        double sum = 0.0;
        double term = first;
        for (int i = from; i < from + 18; i += 2) {
            sum += term;
            term *= -square / ((i + 1) * (i + 2));
        }
        return sum;
    };
    const double quarters = 4.0 * (turns - std::floor(turns));
    const double nearest = std::floor(quarters + 0.5);
    const double x = (quarters - nearest) * 1.57079632679489661923; // radians, from -pi/4 to pi/4
    const double sine = series(x, 1, x * x);
    const double cosine = series(1.0, 0, x * x);
    const std::array<double, 5> values{sine, cosine, -sine, -cosine, sine};
    return values[static_cast<std::size_t>(nearest)];
}

inline double cosTurns(double turns) { return sinTurns(turns + 0.25); }

} // namespace tea_table
