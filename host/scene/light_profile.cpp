#include "host/scene/light_profile.h"

#include "host/scene/limits.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hyalite::core {

namespace {

/// At index `at` of the gammas, the mean of the shares over C.
double meanAround(const LightProfile &profile, std::size_t at) {
    const std::size_t count = profile.gammas.size();
    if (profile.planes.size() == 1)
        return static_cast<double>(profile.shares[at]);
    double sum = 0.0;
    for (std::size_t plane = 0; plane + 1 < profile.planes.size(); ++plane)
        sum += (profile.planes[plane + 1] - profile.planes[plane]) *
               (static_cast<double>(profile.shares[plane * count + at]) +
                static_cast<double>(profile.shares[(plane + 1) * count + at]));
    return sum / 720.0;
}

/// Integral of a share that goes from `first` to `last` between two gammas, times the sine of gamma, from `low` to
/// `high` between them, in radians. By Gauss and Legendre, whose weights are positive: it is 0 only for what is dark.
double integral(double first, double last, double from, double to, double low, double high) {
    constexpr std::pair<double, double> nodes[] = {{0.0694318442029737, 0.1739274225687269},
                                                   {0.3300094782075719, 0.3260725774312731},
                                                   {0.6699905217924281, 0.3260725774312731},
                                                   {0.9305681557970263, 0.1739274225687269}};
    constexpr double widest = 0.1;
    const int pieces = 1 + static_cast<int>((high - low) / widest);
    const double width = (high - low) / pieces;
    double sum = 0.0;
    for (int piece = 0; piece < pieces; ++piece)
        for (const auto &[place, weight] : nodes) {
            const double gamma = low + width * (piece + place);
            const double t = (gamma - from) / (to - from);
            sum += weight * width * (first * (1.0 - t) + last * t) * std::sin(gamma);
        }
    return sum;
}

} // namespace

LitAngles litAnglesOf(const LightProfile &profile) {
    const std::size_t count = profile.gammas.size();
    std::size_t first = count;
    std::size_t last = 0;
    for (std::size_t i = 0; i < profile.shares.size(); ++i)
        if (profile.shares[i] > 0.0f) {
            first = std::min(first, i % count);
            last = std::max(last, i % count);
        }
    if (first == count)
        return {};
    return {profile.gammas[first > 0 ? first - 1 : 0], profile.gammas[std::min(last + 1, count - 1)]};
}

double meanShare(const LightProfile &profile, double angleDegrees) {
    double sum = 0.0;
    double before = meanAround(profile, 0);
    for (std::size_t i = 0; i + 1 < profile.gammas.size() && profile.gammas[i] < angleDegrees; ++i) {
        const double after = meanAround(profile, i + 1);
        const double from = glm::radians(profile.gammas[i]);
        const double to = glm::radians(profile.gammas[i + 1]);
        sum += integral(before, after, from, to, from, std::min(to, glm::radians(angleDegrees)));
        before = after;
    }
    return 0.5 * sum;
}

bool isParallel(const glm::dvec3 &a, const glm::dvec3 &b) {
    return !(glm::length(glm::cross(glm::normalize(a), glm::normalize(b))) >= limits::minSineToUp);
}

glm::dvec3 defaultC0(const glm::dvec3 &direction) {
    constexpr glm::dvec3 x(1.0, 0.0, 0.0);
    return isParallel(direction, x) ? glm::dvec3(0.0, 0.0, 1.0) : x;
}

double lumensOf(const LightProfile &profile) {
    return 4.0 * std::numbers::pi * profile.candela * meanShare(profile);
}

} // namespace hyalite::core
