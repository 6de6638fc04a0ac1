// Sine, cosine, the angle of a vector and the exponential from + - * alone, the same bits everywhere. Twin:
// shaders/math/functions.glsl.
#pragma once

#include "host/reference/vector.h"

#include <bit>
#include <cstdint>
#include <numbers>
#include <type_traits>

namespace hyalite::reference {

template <class Real> struct SineCosine {
    Real sine;
    Real cosine;
};

/// Of an angle in turns, in [0, 1]. The Taylor polynomials of both on an eighth of a turn to either side of the nearest
/// quarter, where they are within 3e-8. In double precision the functions of the standard library.
template <class Real> [[nodiscard]] SineCosine<Real> sineCosine(Real turns) {
    if constexpr (std::is_same_v<Real, double>) {
        const double angle = turns * (2.0 * std::numbers::pi);
        return {std::sin(angle), std::cos(angle)};
    } else {
        const int quarter = static_cast<int>(std::floor(turns * Real(4) + Real(0.5)));
        const Real x = (turns - static_cast<Real>(quarter) * Real(0.25)) * Real(6.2831853071795865);
        const Real xx = x * x;
        const Real s =
            x + x * xx *
                    (Real(-1.0 / 6.0) +
                     xx * (Real(1.0 / 120.0) + xx * (Real(-1.0 / 5040.0) + xx * Real(1.0 / 362880.0))));
        const Real c =
            Real(1) + xx * (Real(-0.5) +
                            xx * (Real(1.0 / 24.0) + xx * (Real(-1.0 / 720.0) + xx * Real(1.0 / 40320.0))));
        const bool isSwapped = (quarter & 1) != 0;
        const Real sine = isSwapped ? c : s;
        const Real cosine = isSwapped ? s : c;
        return {(quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine};
    }
}

/// The angle from the x axis to the vector (x, y), in turns, in [0, 1], within 1e-7. One of both is not 0. The Taylor
/// polynomial of the arc tangent to tan(1/16 turn), where it is within 2e-8; further up, of the angle to the diagonal. In
/// double precision the function of the standard library.
template <class Real> [[nodiscard]] Real turnsOf(Real y, Real x) {
    if constexpr (std::is_same_v<Real, double>) {
        const double turns = std::atan2(y, x) / (2.0 * std::numbers::pi);
        return turns < 0.0 ? turns + 1.0 : turns;
    } else {
        const Real low = lesser(std::abs(x), std::abs(y));
        const Real high = greater(std::abs(x), std::abs(y));
        const bool isFar = low > high * Real(0.41421356237309505);
        const Real t = (isFar ? low - high : low) / (isFar ? low + high : high);
        const Real tt = t * t;
        const Real series =
            Real(-1.0 / 3.0) +
            tt * (Real(1.0 / 5.0) +
                  tt * (Real(-1.0 / 7.0) +
                        tt * (Real(1.0 / 9.0) +
                              tt * (Real(-1.0 / 11.0) + tt * (Real(1.0 / 13.0) + tt * Real(-1.0 / 15.0))))));
        const Real angle = (t + t * tt * series) * Real(0.15915494309189535);
        Real turns = isFar ? angle + Real(0.125) : angle;
        turns = std::abs(y) > std::abs(x) ? Real(0.25) - turns : turns;
        turns = x < 0 ? Real(0.5) - turns : turns;
        return y < 0 ? Real(1) - turns : turns;
    }
}

/// e^-x for x >= 0: a power of 2 as an exponent, and the Taylor polynomial around the middle of what remains. Within
/// 2e-7 (1 + x) of the result, exactly 1 at 0, and 0 from 86 on. In double precision the function of the standard
/// library.
template <class Real> [[nodiscard]] Real decay(Real x) {
    if constexpr (std::is_same_v<Real, double>) {
        return std::exp(-x);
    } else {
        const Real t = lesser(x, Real(86)) * Real(1.4426950408889634);
        const int k = static_cast<int>(t);
        const Real y = (static_cast<Real>(k) + Real(0.5) - t) * Real(0.69314718055994531);
        const Real power =
            Real(1) +
            y * (Real(1) + y * (Real(0.5) + y * (Real(1.0 / 6.0) +
                                                 y * (Real(1.0 / 24.0) +
                                                      y * (Real(1.0 / 120.0) + y * Real(1.0 / 720.0))))));
        const Real scaled = power * (std::bit_cast<float>((127 - k) << 23) * Real(0.70710678118654752));
        return x < Real(86) ? (x > Real(0) ? scaled : Real(1)) : Real(0);
    }
}

template <class Real> [[nodiscard]] Vec3<Real> decay(const Vec3<Real> &x) {
    return {decay(x.x), decay(x.y), decay(x.z)};
}

} // namespace hyalite::reference
