#include "tests/images/plain_thin_film.h"

#include "tests/images/plain_microfacets.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>

namespace hyalite::core::testing::plain {

namespace {

constexpr double pi = std::numbers::pi;

double schlick(double cosine, double normal) { return normal + (1.0 - normal) * std::pow(1.0 - cosine, 5.0); }

/// A lobe of a matching function over waves per metre: a Gaussian, by Belcour and Barla's published code. They give
/// half of the variance.
struct Lobe {
    double height;
    double centre;
    double halfVariance;

    [[nodiscard]] double at(double waves) const {
        // The integral is height sqrt(2 pi halfVariance).
        return height / std::numbers::sqrt2 *
               std::exp(-(waves - centre) * (waves - centre) / (4.0 * halfVariance));
    }
};

constexpr Lobe upperX{5.4856e-13, 1.6810e6, 4.3278e9};
constexpr Lobe lowerX{9.7470e-14, 2.2399e6, 4.5282e9};
constexpr Lobe y{4.4201e-13, 1.7953e6, 9.3046e9};
constexpr Lobe z{5.2481e-13, 2.2084e6, 6.6121e9};

/// From XYZ to the primaries of Rec. 709 (ITU-R BT.709, with the white of D65).
Vec linearRgb(const Vec &xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

} // namespace

double airyReflectance(double upper, double lower, double behind, bool isDense) {
    const double first = -std::sqrt(upper);
    const std::complex<double> second =
        (isDense ? -1.0 : 1.0) * std::sqrt(lower) * std::polar(1.0, 2.0 * pi * behind);
    return std::norm((first + second) / (1.0 + first * second));
}

ThinFilm::ThinFilm(double index, double thickness, const Vec &bare, bool isLight)
    : index_(index), thickness_(thickness) {
    for (int channel = 0; channel < 3; ++channel) {
        const double root = (isLight ? -1.0 : 1.0) * std::sqrt(bare[channel]);
        if (root >= 1.0) {
            amplitudes_[static_cast<std::size_t>(channel)] = 1.0;
            continue;
        }
        const double below = (1.0 + root) / (1.0 - root); // its refractive index
        amplitudes_[static_cast<std::size_t>(channel)] = (below - index) / (below + index);
    }
    for (std::size_t i = 0; i < table_.size(); ++i)
        table_[i] = reflectance(static_cast<double>(i) / static_cast<double>(table_.size() - 1));
}

Vec ThinFilm::reflectance(double cosine) const {
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index_ * index_)); // Snell's law
    const double upper = schlick(cosine, std::pow((index_ - 1.0) / (index_ + 1.0), 2.0));
    constexpr int steps = 400;
    Vec sum(0.0);
    Vec white(0.0);
    for (int i = 0; i < steps; ++i) {
        const double waves = 1e6 + 2e6 * (i + 0.5) / steps; // wavelengths from 1000 to 333 nm
        const Vec weight = linearRgb({upperX.at(waves) + lowerX.at(waves), y.at(waves), z.at(waves)});
        white += weight;
        for (int channel = 0; channel < 3; ++channel) {
            const double amplitude = amplitudes_[static_cast<std::size_t>(channel)];
            const double lower = schlick(inside, amplitude * amplitude);
            const double behind = 2.0 * index_ * thickness_ * 1e-9 * inside * waves;
            sum[channel] += weight[channel] * airyReflectance(upper, lower, behind, amplitude > 0.0);
        }
    }
    return glm::clamp(sum / white, 0.0, 1.0);
}

Vec ThinFilm::at(double cosine) const {
    const double place = std::clamp(cosine, 0.0, 1.0) * static_cast<double>(table_.size() - 1);
    const auto cell = std::min(static_cast<std::size_t>(place), table_.size() - 2);
    return glm::mix(table_[cell], table_[cell + 1], place - static_cast<double>(cell));
}

double ThinFilm::loss(double cosine) const {
    const Vec reflected = at(cosine);
    return std::max({reflected.x, reflected.y, reflected.z});
}

Vec ThinFilm::average() const {
    Vec sum(0.0);
    for (const Vec &reflected : table_)
        sum += reflected * (2.0 * static_cast<double>(&reflected - table_.data()));
    const auto last = static_cast<double>(table_.size() - 1);
    return (sum - table_.back() * last) / (last * last); // the trapezoidal rule
}

double ThinFilm::energy(double cosine, double roughness) const {
    constexpr std::size_t count = 65;
    static std::mutex mutex;
    static std::map<std::pair<const ThinFilm *, double>, std::array<double, count>> tables;
    const std::lock_guard lock(mutex);
    const auto [entry, isNew] = tables.try_emplace({this, roughness});
    std::array<double, count> &table = entry->second;
    for (std::size_t i = 0; isNew && i < count; ++i) {
        const double height = std::pow(static_cast<double>(i) / (count - 1), 2.0);
        table[i] =
            integrateReflected(height, alphaOf(roughness), 96, [&](double toFacet) { return loss(toFacet); });
    }
    const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (count - 1);
    const auto cell = std::min(static_cast<std::size_t>(place), count - 2);
    return glm::mix(table[cell], table[cell + 1], place - static_cast<double>(cell));
}

const ThinFilm &thinFilmOf(double index, double thickness, const Vec &bare, bool isLight) {
    using Key = std::tuple<double, double, double, double, double, bool>;
    static std::mutex mutex;
    static std::map<Key, ThinFilm> films;
    const std::lock_guard lock(mutex);
    return films
        .try_emplace({index, thickness, bare.x, bare.y, bare.z, isLight}, index, thickness, bare, isLight)
        .first->second;
}

} // namespace hyalite::core::testing::plain
