#include "tests/images/plain_microfacets.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

namespace hyalite::core::testing::plain {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double minRoughness = 0.04; // what is rougher than nothing is at least so rough

double squared(double x) { return x * x; }

double fifthPower(double x) { return squared(squared(x)) * x; }

Vec facetOf(double share, double turn, double alpha) {
    const double cosine = std::sqrt((1.0 - share) / (1.0 - share + alpha * alpha * share));
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

double slopeRoot(const Vec &w, double alpha) { // sqrt(1 + alpha^2 tan^2)
    return std::sqrt(1.0 + alpha * alpha * (w.x * w.x + w.y * w.y) / (w.z * w.z));
}

/// Energies at one roughness.
class Row {
  public:
    void fill(double roughness) {
        const double alpha = roughness * roughness;
        constexpr double width = 1.0 / (nodeCount - 1);
        for (std::size_t i = 0; i < nodeCount; ++i)
            nodes_[i] = integrateEnergy(squared(static_cast<double>(i) * width), alpha, 96);
        // Twice the integral of E cos over cos: 4 E x^3 over x, the square root of the cosine.
        average_ = {0.0, 0.0};
        for (std::size_t i = 0; i + 1 < nodeCount; ++i)
            for (const double half : {0.25, 0.75}) {
                const double x = (static_cast<double>(i) + half) * width;
                const Energy energy = at(x * x);
                average_.white += 2.0 * width * x * x * x * energy.white;
                average_.grazing += 2.0 * width * x * x * x * energy.grazing;
            }
    }

    [[nodiscard]] Energy at(double cosine) const {
        const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (nodeCount - 1);
        const std::size_t cell = std::min(static_cast<std::size_t>(place), nodeCount - 2);
        const double share = place - static_cast<double>(cell);
        return {glm::mix(nodes_[cell].white, nodes_[cell + 1].white, share),
                glm::mix(nodes_[cell].grazing, nodes_[cell + 1].grazing, share)};
    }

    [[nodiscard]] Energy average() const { return average_; }

  private:
    static constexpr std::size_t nodeCount = 65;
    std::array<Energy, nodeCount> nodes_{};
    Energy average_;
};

constexpr std::size_t rowCount = 129;

const Row &rowAt(std::size_t index) {
    static std::array<Row, rowCount> rows;
    static std::array<std::once_flag, rowCount> flags;
    std::call_once(flags[index],
                   [&] { rows[index].fill(static_cast<double>(index) / static_cast<double>(rowCount - 1)); });
    return rows[index];
}

template <class Read> Energy betweenRows(double roughness, const Read &read) {
    const double place = std::clamp(roughness, minRoughness, 1.0) * static_cast<double>(rowCount - 1);
    const std::size_t cell = std::min(static_cast<std::size_t>(place), rowCount - 2);
    const double share = place - static_cast<double>(cell);
    const Energy low = read(rowAt(cell));
    const Energy high = read(rowAt(cell + 1));
    return {glm::mix(low.white, high.white, share), glm::mix(low.grazing, high.grazing, share)};
}

/// Of glass of one roughness and index.
class GlassRow {
  public:
    GlassRow(double roughness, double indexRatio) {
        for (std::size_t i = 0; i < nodeCount; ++i)
            nodes_[i] = integrateGlassEnergy(squared(static_cast<double>(i) / (nodeCount - 1)),
                                             squared(roughness), indexRatio, 96);
    }

    [[nodiscard]] double at(double cosine) const {
        const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (nodeCount - 1);
        const std::size_t cell = std::min(static_cast<std::size_t>(place), nodeCount - 2);
        return glm::mix(nodes_[cell], nodes_[cell + 1], place - static_cast<double>(cell));
    }

  private:
    static constexpr std::size_t nodeCount = 65;
    std::array<double, nodeCount> nodes_{};
};

const GlassRow &glassRowAt(std::size_t index, double indexRatio) {
    using Key = std::pair<std::size_t, double>;
    static std::map<Key, GlassRow> rows;
    static std::mutex mutex;
    thread_local std::map<Key, const GlassRow *> found;
    const GlassRow *&row = found[{index, indexRatio}];
    if (row == nullptr) {
        const std::scoped_lock lock(mutex);
        const double roughness = static_cast<double>(index) / static_cast<double>(rowCount - 1);
        row = &rows.try_emplace({index, indexRatio}, roughness, indexRatio).first->second;
    }
    return *row;
}

} // namespace

double dielectricFresnel(double cosine, double indexRatio) {
    const double sineBeyond = indexRatio * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    if (sineBeyond >= 1.0)
        return 1.0;
    const double beyond = std::sqrt(1.0 - sineBeyond * sineBeyond);
    const double across = (indexRatio * cosine - beyond) / (indexRatio * cosine + beyond);
    const double along = (cosine - indexRatio * beyond) / (cosine + indexRatio * beyond);
    return 0.5 * (across * across + along * along);
}

double conductorFresnel(double cosine, double n, double k) {
    const std::complex<double> squaredIndex = std::complex<double>(n, k) * std::complex<double>(n, k);
    const std::complex<double> beyond = std::sqrt(squaredIndex - (1.0 - cosine * cosine));
    const std::complex<double> across = (cosine - beyond) / (cosine + beyond);
    const std::complex<double> along = (squaredIndex * cosine - beyond) / (squaredIndex * cosine + beyond);
    return 0.5 * (std::norm(across) + std::norm(along));
}

double averageConductorFresnel(double n, double k) {
    constexpr int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        sum += conductorFresnel(std::sqrt((i + 0.5) / steps), n, k); // squared cosines are evenly spread
    return sum / steps;
}

Vec schlickFresnel(double cosine, const Vec &normalReflectance, double grazing) {
    return normalReflectance + (grazing - normalReflectance) * std::pow(1.0 - cosine, 5.0);
}

double alphaOf(double roughness) { return squared(std::max(roughness, minRoughness)); }

double ggx(const Vec &facet, double alpha) {
    const double squaredTangent = (facet.x * facet.x + facet.y * facet.y) / squared(facet.z);
    return squared(alpha) / (pi * squared(squared(facet.z)) * squared(squared(alpha) + squaredTangent));
}

double smith(const Vec &view, const Vec &light, double alpha) {
    const double lambdaView = (slopeRoot(view, alpha) - 1.0) / 2.0;
    const double lambdaLight = (slopeRoot(light, alpha) - 1.0) / 2.0;
    return 1.0 / (1.0 + lambdaView + lambdaLight);
}

Vec randomFacet(double alpha, Generator &generator) {
    const double share = uniform(generator);
    return facetOf(share, 2.0 * pi * uniform(generator), alpha);
}

namespace {

/// Visits facets by the cosine to the view, with the share of the light that they reflect at once.
template <class Visit> void forEachFacet(double cosine, double alpha, int steps, const Visit &visit) {
    const double height = std::max(cosine, 1e-9);
    const Vec view(std::sqrt(1.0 - height * height), 0.0, height);
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        const double share = squared(std::sin(pi * t / 2.0)); // fine at both ends
        const double weight = pi / 2.0 * std::sin(pi * t) / squared(static_cast<double>(steps));
        for (int j = 0; j < steps; ++j) {
            const Vec facet =
                facetOf(share, pi * (j + 0.5) / steps, alpha); // half a turn: the rest is its mirror image
            const double toFacet = glm::dot(view, facet);
            const Vec light = 2.0 * toFacet * facet - view;
            if (toFacet <= 0.0 || light.z <= 0.0)
                continue;
            const double reflected = weight * smith(view, light, alpha) * toFacet / (view.z * facet.z);
            visit(std::min(toFacet, 1.0), reflected);
        }
    }
}

} // namespace

Energy integrateEnergy(double cosine, double alpha, int steps) {
    Energy sum{0.0, 0.0};
    forEachFacet(cosine, alpha, steps, [&](double toFacet, double reflected) {
        sum.white += reflected;
        sum.grazing += reflected * fifthPower(1.0 - toFacet);
    });
    return sum;
}

double integrateReflected(double cosine, double alpha, int steps,
                          const std::function<double(double)> &fresnel) {
    double sum = 0.0;
    forEachFacet(cosine, alpha, steps,
                 [&](double toFacet, double reflected) { sum += reflected * fresnel(toFacet); });
    return sum;
}

double integrateGlassEnergy(double cosine, double alpha, double indexRatio, int steps) {
    double sum = 0.0;
    const double height = std::max(cosine, 1e-9);
    const Vec view(std::sqrt(1.0 - height * height), 0.0, height);
    for (int j = 0; j < steps; ++j) {
        // Heights differ from azimuth to azimuth: seen from above, total reflection begins at one height.
        const double shift = std::fmod((j + 0.5) * std::numbers::phi, 1.0);
        for (int i = 0; i < steps; ++i) {
            const double t = (i + shift) / steps;
            const double share = squared(std::sin(pi * t / 2.0)); // fine at both ends
            const double weight = pi / 2.0 * std::sin(pi * t) / squared(static_cast<double>(steps));
            const Vec facet = facetOf(share, pi * (j + 0.5) / steps, alpha);
            const double toFacet = glm::dot(view, facet);
            if (toFacet <= 0.0)
                continue;
            const double seen = weight * toFacet / (view.z * facet.z);
            const double fresnel = dielectricFresnel(std::min(toFacet, 1.0), indexRatio);
            const Vec reflected = 2.0 * toFacet * facet - view;
            if (reflected.z > 0.0)
                sum += seen * fresnel * smith(view, reflected, alpha);
            if (fresnel == 1.0)
                continue;
            const double beyond =
                std::sqrt(1.0 - squared(indexRatio) * (1.0 - squared(toFacet))); // Snell's law
            const Vec refracted = (indexRatio * toFacet - beyond) * facet - indexRatio * view;
            if (refracted.z < 0.0)
                sum += seen * (1.0 - fresnel) * smith(view, refracted, alpha);
        }
    }
    return sum;
}

double glassEnergy(double cosine, double roughness, double indexRatio) {
    const double place = std::clamp(roughness, minRoughness, 1.0) * static_cast<double>(rowCount - 1);
    const std::size_t cell = std::min(static_cast<std::size_t>(place), rowCount - 2);
    return glm::mix(glassRowAt(cell, indexRatio).at(cosine), glassRowAt(cell + 1, indexRatio).at(cosine),
                    place - static_cast<double>(cell));
}

Energy directionalEnergy(double cosine, double roughness) {
    return betweenRows(roughness, [&](const Row &row) { return row.at(cosine); });
}

Energy averageEnergy(double roughness) {
    return betweenRows(roughness, [](const Row &row) { return row.average(); });
}

namespace {

/// Equation 3, with the coefficients of table 1.
double sheenLambda(double cosine, double alpha) {
    const double t = (1.0 - alpha) * (1.0 - alpha);
    const double a = glm::mix(21.5473, 25.3245, t);
    const double b = glm::mix(3.82987, 3.32435, t);
    const double c = glm::mix(0.19823, 0.16801, t);
    const double d = glm::mix(-1.97760, -1.27393, t);
    const double e = glm::mix(-4.32054, -4.85967, t);
    const auto curve = [&](double x) { return a / (1.0 + b * std::pow(x, c)) + d * x + e; };
    return cosine < 0.5 ? std::exp(curve(cosine)) : std::exp(2.0 * curve(0.5) - curve(1.0 - cosine));
}

double integrateSheen(double cosine, double roughness) {
    constexpr int steps = 200;
    const Vec view(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = (i + 0.5) / steps;
            const double turn = std::numbers::pi * (j + 0.5) / steps;
            const double sine = std::sqrt(1.0 - z * z);
            sum += sheen(view, {sine * std::cos(turn), sine * std::sin(turn), z}, roughness);
        }
    return sum * 2.0 * std::numbers::pi / (steps * steps);
}

} // namespace

double sheen(const Vec &view, const Vec &light, double roughness) {
    const double alpha = std::pow(std::max(roughness, 0.07), 2.0);
    const double cosine = std::min(glm::normalize(view + light).z, 1.0);
    const double density =
        (2.0 + 1.0 / alpha) * std::pow(1.0 - cosine * cosine, 0.5 / alpha) / (2.0 * std::numbers::pi);
    const double masking = 1.0 / (1.0 + sheenLambda(view.z, alpha) + sheenLambda(light.z, alpha));
    return density * masking / (4.0 * view.z);
}

double sheenEnergy(double cosine, double roughness) {
    constexpr std::size_t count = 65;
    static std::mutex mutex;
    static std::map<double, std::array<double, count>> tables;
    const std::lock_guard lock(mutex);
    const auto [entry, isNew] = tables.try_emplace(roughness);
    std::array<double, count> &table = entry->second;
    for (std::size_t i = 0; isNew && i < count; ++i)
        table[i] = integrateSheen(std::max(static_cast<double>(i) / (count - 1), 1e-3), roughness);
    const double place = std::clamp(cosine, 0.0, 1.0) * (count - 1);
    const auto cell = std::min(static_cast<std::size_t>(place), count - 2);
    return glm::mix(table[cell], table[cell + 1], place - static_cast<double>(cell));
}

} // namespace hyalite::core::testing::plain
