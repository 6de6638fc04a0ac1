#include "host/packing/microfacet_energy.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hyalite {

namespace {

constexpr std::size_t cosineCount = layout::energyCosines;
constexpr std::size_t roughnessCount = layout::energyRoughnesses;
constexpr std::size_t azimuthSteps = 32; // over half a turn; the other half is symmetric
constexpr std::size_t heightSteps = 48;

struct Energy {
    double white = 0.0;
    double grazing = 0.0;
};

using EnergyRow = std::array<Energy, cosineCount>;

/// Cosines and sines of the midpoints of `azimuthSteps` intervals over half a turn.
struct Azimuths {
    std::array<double, azimuthSteps> cosine;
    std::array<double, azimuthSteps> sine;

    Azimuths() {
        static_assert(azimuthSteps == 32);
        double c = 0.0; // cosine of a quarter turn, halved to a 128th of a turn, which is half a step
        for (int i = 0; i < 5; ++i)
            c = std::sqrt(0.5 + 0.5 * c);
        const double s = std::sqrt(1.0 - c * c);
        const double stepCosine = c * c - s * s;
        const double stepSine = 2.0 * s * c;
        cosine[0] = c;
        sine[0] = s;
        for (std::size_t i = 1; i < azimuthSteps; ++i) {
            cosine[i] = cosine[i - 1] * stepCosine - sine[i - 1] * stepSine;
            sine[i] = sine[i - 1] * stepCosine + cosine[i - 1] * stepSine;
        }
    }
};

double fifthPower(double x) { return x * x * (x * x) * x; }

/// An average over the facets that are seen from a direction, of how many of them are lit by what they reflect. The cap
/// of Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023, is cut into equal parts.
Energy energyOf(double cosine, double alpha, const Azimuths &azimuths) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double stretch = std::sqrt(alpha * alpha * sine * sine + cosine * cosine);
    const double x = alpha * sine / stretch;
    const double z = cosine / stretch;
    Energy sum;
    double totalWeight = 0.0;
    for (std::size_t k = 0; k < heightSteps; ++k) {
        // The ends contain few facets but matter much, so steps are narrow there.
        const double t = (static_cast<double>(k) + 0.5) / heightSteps;
        const double share = t * t * (3.0 - 2.0 * t);
        const double weight = 6.0 * t * (1.0 - t);
        totalWeight += weight;
        const double capHeight = (1.0 - share) * (1.0 + z) - z;
        const double capSine = std::sqrt(1.0 - capHeight * capHeight);
        for (std::size_t i = 0; i < azimuthSteps; ++i) {
            const double facetX = alpha * (capSine * azimuths.cosine[i] + x);
            const double facetY = alpha * (capSine * azimuths.sine[i]);
            const double facetZ = capHeight + z;
            const double length = std::sqrt(facetX * facetX + facetY * facetY + facetZ * facetZ);
            const double toFacet = (sine * facetX + cosine * facetZ) / length;
            const double lightX = 2.0 * toFacet * facetX / length - sine;
            const double lightY = 2.0 * toFacet * facetY / length;
            const double lightZ = 2.0 * toFacet * facetZ / length - cosine;
            if (lightZ <= 0.0)
                continue;
            const double lightStretch =
                std::sqrt(alpha * alpha * (lightX * lightX + lightY * lightY) + lightZ * lightZ);
            const double lit = lightZ * (cosine + stretch) / (cosine * lightStretch + lightZ * stretch);
            sum.white += weight * lit;
            sum.grazing += weight * lit * fifthPower(1.0 - std::fmin(toFacet, 1.0));
        }
    }
    const double total = totalWeight * static_cast<double>(azimuthSteps);
    return {sum.white / total, sum.grazing / total}; // at most 1
}

EnergyRow energiesOf(double alpha) {
    const Azimuths azimuths;
    EnergyRow row;
    for (std::size_t i = 0; i < cosineCount; ++i) {
        const double root = static_cast<double>(i) / static_cast<double>(cosineCount - 1);
        const double cosine = root * root;
        row[i] = alpha > 0.0 ? energyOf(cosine, alpha, azimuths) : Energy{1.0, fifthPower(1.0 - cosine)};
        // Rounded to float as the kernels read them, so that the averages below match theirs.
        row[i] = {static_cast<float>(row[i].white), static_cast<float>(row[i].grazing)};
    }
    return row;
}

/// 2 times the integral of E cos over cos, where E is linear in x = sqrt(cos) between nodes: 4 times that of E x^3 over
/// x.
Energy averageOf(const EnergyRow &row) {
    Energy average;
    for (std::size_t i = 0; i + 1 < cosineCount; ++i) {
        constexpr double width = 1.0 / static_cast<double>(cosineCount - 1);
        const double a = static_cast<double>(i) * width;
        const double b = static_cast<double>(i + 1) * width;
        const double whole = (b * b * b * b - a * a * a * a) / 4.0;
        const double ofEnd = ((b * b * b * b * b - a * a * a * a * a) / 5.0 - a * whole) / width;
        average.white += 4.0 * (row[i].white * (whole - ofEnd) + row[i + 1].white * ofEnd);
        average.grazing += 4.0 * (row[i].grazing * (whole - ofEnd) + row[i + 1].grazing * ofEnd);
    }
    return average;
}

layout::LookupRow texel(double x, double y, double z, double w) {
    return {glm::vec3(x, y, z), std::bit_cast<std::uint32_t>(static_cast<float>(w))};
}

} // namespace

std::vector<layout::LookupRow> makeEnergyTexels() {
    std::array<EnergyRow, roughnessCount> rows;
    std::array<Energy, roughnessCount> averages;
#pragma omp parallel for schedule(dynamic)
    for (std::size_t j = 0; j < roughnessCount; ++j) {
        const double roughness = static_cast<double>(j) / static_cast<double>(roughnessCount - 1);
        rows[j] = energiesOf(roughness * roughness);
        averages[j] = averageOf(rows[j]);
    }
    std::vector<layout::LookupRow> texels;
    texels.reserve(layout::energyTexelCount);
    for (std::size_t j = 0; j + 1 < roughnessCount; ++j)
        for (std::size_t i = 0; i + 1 < cosineCount; ++i) {
            texels.push_back(texel(rows[j][i].white, rows[j][i + 1].white, rows[j + 1][i].white,
                                   rows[j + 1][i + 1].white));
            texels.push_back(texel(rows[j][i].grazing, rows[j][i + 1].grazing, rows[j + 1][i].grazing,
                                   rows[j + 1][i + 1].grazing));
        }
    for (std::size_t j = 0; j + 1 < roughnessCount; ++j)
        texels.push_back(
            texel(averages[j].white, averages[j + 1].white, averages[j].grazing, averages[j + 1].grazing));
    return texels;
}

double averageConductorReflectance(double index, double extinction) {
    constexpr int steps = 1024;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        const double squaredSine = 1.0 - cosine * cosine;
        // a + i b is the square root of (n + i k)^2 - sin^2.
        const double real = index * index - extinction * extinction - squaredSine;
        const double imaginary = 2.0 * index * extinction;
        const double length = std::sqrt(real * real + imaginary * imaginary);
        const double a = std::sqrt(std::fmax(0.5 * (length + real), 0.0));
        const double across =
            (length + cosine * cosine - 2.0 * a * cosine) / (length + cosine * cosine + 2.0 * a * cosine);
        const double tangential = squaredSine * squaredSine / (cosine * cosine);
        const double mixed = 2.0 * a * squaredSine / cosine;
        const double along = across * (length + tangential - mixed) / (length + tangential + mixed);
        sum += 0.5 * (across + along) * cosine;
    }
    return 2.0 * sum / steps;
}

} // namespace hyalite
