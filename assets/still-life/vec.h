// Points, directions and colours of the still life.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace still_life {

using Vec = std::array<double, 3>;

inline constexpr double pi = 3.14159265358979323846;

inline Vec add(const Vec &a, const Vec &b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec scale(const Vec &a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline Vec mix(const Vec &a, const Vec &b, double share) {
    return add(scale(a, 1.0 - share), scale(b, share));
}
inline Vec cross(const Vec &a, const Vec &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec normalise(const Vec &v) {
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return length > 0.0 ? scale(v, 1.0 / length) : v;
}

inline double clamp01(double x) { return std::fmin(std::fmax(x, 0.0), 1.0); }

/// From 0 to 1 between the edges.
inline double smoothStep(double from, double to, double x) {
    const double t = clamp01((x - from) / (to - from));
    return t * t * (3.0 - 2.0 * t);
}

} // namespace still_life
