// Exponential and logarithm in double precision, made of + - * / only: pow() and log() of C libraries differ in the
// last bit. Leaf functions have those of float32 (shaders/math/functions.glsl).
#pragma once

#include <cmath>
#include <numbers>

namespace hyalite::core {

/// 2^x, for |x| <= 1000.
[[nodiscard]] inline double exp2Portable(double x) {
    constexpr int termCount = 20; // |r| <= ln2 / 2, and r^20 / 20! < 2^-90
    const double whole = std::round(x);
    const double r = (x - whole) * std::numbers::ln2;
    double sum = 1.0; // Horner's form of the sum of r^k / k!
    for (int k = termCount; k >= 1; --k)
        sum = 1.0 + r * sum / k;
    return std::ldexp(sum, static_cast<int>(whole));
}

/// log2(x), for finite x > 0, to a few ulps.
[[nodiscard]] inline double log2Portable(double x) {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent) * 2.0; // in [1, 2)
    const bool isUpper = mantissa > 1.4142135623730951;
    const double m = isUpper ? mantissa * 0.5 : mantissa;
    const double s = (m - 1.0) / (m + 1.0); // |s| < 0.172: ln m = 2 (s + s^3 / 3 + s^5 / 5 + ...)
    double sum = 0.0;
    for (int k = 23; k >= 1; k -= 2)
        sum = sum * s * s + 1.0 / k;
    return (isUpper ? exponent : exponent - 1) + 2.0 * s * sum / std::numbers::ln2;
}

} // namespace hyalite::core
