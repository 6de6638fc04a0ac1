#include "host/image/tone_curve.h"

#include "host/base/portable_math.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace hyalite::core {

namespace {

/// A matrix from its rows, as papers print it; GLM takes columns.
glm::dmat3 rows(const glm::dvec3 &a, const glm::dvec3 &b, const glm::dvec3 &c) {
    return {a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

glm::dvec3 aces(const glm::dvec3 &radiance) {
    static const glm::dmat3 toFilm =
        rows({0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777});
    static const glm::dmat3 fromFilm =
        rows({1.60475, -0.53108, -0.07367}, {-0.10208, 1.10813, -0.00605}, {-0.00327, -0.07276, 1.07602});
    const glm::dvec3 v = toFilm * radiance;
    const glm::dvec3 fitted =
        (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    const glm::dvec3 linear = glm::clamp(fromFilm * fitted, 0.0, 1.0);
    return {srgbEncoded(linear.x), srgbEncoded(linear.y), srgbEncoded(linear.z)};
}

double agxContrast(double radiance) {
    constexpr double minStops = -12.47393; // log2 of radiance
    constexpr double maxStops = 4.026069;
    const double stops = radiance > 0.0 ? log2Portable(radiance) : minStops;
    const double x = (std::clamp(stops, minStops, maxStops) - minStops) / (maxStops - minStops);
    return (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
}

glm::dvec3 agx(const glm::dvec3 &radiance) {
    static const glm::dmat3 inset = rows({0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                         {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                         {0.0423756549057051, 0.0784336, 0.879142973793104});
    static const glm::dmat3 outset = rows({1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                          {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                          {-0.0529716355144438, -0.0980434501171241, 1.15107367264116});
    const glm::dvec3 v = inset * radiance;
    return glm::clamp(outset * glm::dvec3(agxContrast(v.x), agxContrast(v.y), agxContrast(v.z)), 0.0, 1.0);
}

double bounded(double radiance) { return radiance > 0.0 ? std::min(radiance, 0x1p60) : 0.0; } // NaN: 0

} // namespace

double srgbEncoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * exp2Portable(log2Portable(linear) / 2.4) - 0.055;
}

double srgbDecoded(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

const std::array<float, 256> &srgbDecodedLevels() {
    static const std::array<float, 256> linear = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(srgbDecoded(static_cast<double>(i) / 255.0));
        return values;
    }();
    return linear;
}

glm::dvec3 displayed(const glm::dvec3 &radiance, ToneCurve curve) {
    const glm::dvec3 c(bounded(radiance.x), bounded(radiance.y), bounded(radiance.z));
    const auto gamma = [](double linear) {
        return linear > 0.0 ? exp2Portable(log2Portable(std::min(linear, 1.0)) / 2.2) : 0.0;
    };
    switch (curve) {
    case ToneCurve::Gamma:
        return {gamma(c.x), gamma(c.y), gamma(c.z)};
    case ToneCurve::Srgb:
        return {srgbEncoded(std::min(c.x, 1.0)), srgbEncoded(std::min(c.y, 1.0)),
                srgbEncoded(std::min(c.z, 1.0))};
    case ToneCurve::Aces:
        return aces(c);
    case ToneCurve::Agx:
        return agx(c);
    }
    return c;
}

} // namespace hyalite::core
