#include "host/packing/sheen_energy.h"

#include "host/base/portable_math.h"
#include "host/leaves/leaves.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace hyalite::core {

namespace {

constexpr int heightSteps = 64;   ///< over the cosine of the light
constexpr int sheenAzimuths = 32; ///< over half a turn

double exponential(double x) { return exp2Portable(x / std::numbers::ln2); }

double power(double base, double exponent) {
    return base > 0.0 ? exp2Portable(exponent * log2Portable(base)) : 0.0;
}

/// sheenLambda of shaders/bsdf/sheen.glsl, with powers in double precision.
double lambda(double cosine, double alpha) {
    const auto fit = leaves::sheenFit(alpha);
    const auto curve = [&](double x) { return leaves::sheenCurve(fit, x, power(x, fit.c)); };
    return exponential(cosine < 0.5 ? curve(cosine) : 2.0 * curve(0.5) - curve(1.0 - cosine));
}

/// The share of light from everywhere that comes to the viewer. The midpoint rule.
double albedoOf(double viewCosine, double alpha, const std::array<double, sheenAzimuths> &azimuthCosines) {
    const double viewSine = std::sqrt(1.0 - viewCosine * viewCosine);
    const double viewLambda = lambda(viewCosine, alpha);
    double sum = 0.0;
    for (int i = 0; i < heightSteps; ++i) {
        const double lightCosine = (i + 0.5) / heightSteps;
        const double lightSine = std::sqrt(1.0 - lightCosine * lightCosine);
        const double masked = 1.0 + viewLambda + lambda(lightCosine, alpha);
        for (const double azimuthCosine : azimuthCosines) {
            const double between = viewCosine * lightCosine + viewSine * lightSine * azimuthCosine;
            const double height =
                (viewCosine + lightCosine) * (viewCosine + lightCosine) / (2.0 + 2.0 * between);
            const double squaredSine = std::fmax(1.0 - height, 0.0);
            const double density = (2.0 + 1.0 / alpha) * power(squaredSine, 0.5 / alpha);
            sum += density / masked;
        }
    }
    // The lobe times the light's cosine is D / (4 cos masked); D lacks 1 / (2 pi), and the hemisphere has 2 pi.
    return sum / (4.0 * viewCosine) / (heightSteps * sheenAzimuths);
}

/// Cosines of the midpoints of `sheenAzimuths` intervals over half a turn, by halving a quarter turn.
std::array<double, sheenAzimuths> azimuths() {
    static_assert(sheenAzimuths == 32);
    double c = 0.0;
    for (int i = 0; i < 5; ++i)
        c = std::sqrt(0.5 + 0.5 * c);
    const double s = std::sqrt(1.0 - c * c);
    double cosine = c;
    double sine = s;
    std::array<double, sheenAzimuths> cosines{};
    for (double &entry : cosines) {
        entry = cosine;
        const double nextCosine = cosine * (c * c - s * s) - sine * (2.0 * s * c);
        sine = sine * (c * c - s * s) + cosine * (2.0 * s * c);
        cosine = nextCosine;
    }
    return cosines;
}

} // namespace

std::vector<layout::LookupRow> makeSheenTexels() {
    const std::array<double, sheenAzimuths> azimuthCosines = azimuths();
    std::array<std::array<float, layout::energyCosines>, layout::energyRoughnesses> albedos{};
#pragma omp parallel for schedule(dynamic)
    for (std::size_t j = 0; j < layout::energyRoughnesses; ++j)
        for (std::size_t i = 0; i < layout::energyCosines; ++i) {
            const double roughness =
                static_cast<double>(j) / static_cast<double>(layout::energyRoughnesses - 1);
            const double root =
                std::fmax(static_cast<double>(i) / static_cast<double>(layout::energyCosines - 1), 1e-3);
            albedos[j][i] =
                static_cast<float>(albedoOf(root * root, leaves::sheenAlphaOf(roughness), azimuthCosines));
        }
    std::vector<layout::LookupRow> texels;
    texels.reserve(layout::sheenTexelCount);
    for (std::size_t j = 0; j + 1 < layout::energyRoughnesses; ++j)
        for (std::size_t i = 0; i + 1 < layout::energyCosines; ++i)
            texels.push_back({glm::vec3(albedos[j][i], albedos[j][i + 1], albedos[j + 1][i]),
                              std::bit_cast<std::uint32_t>(albedos[j + 1][i + 1])});
    return texels;
}

} // namespace hyalite::core
