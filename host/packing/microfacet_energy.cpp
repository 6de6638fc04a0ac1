#include "host/packing/microfacet_energy.h"

#include "host/leaves/leaves.h"

#include <glm/vec3.hpp>

#include <array>
#include <bit>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hyalite::core {

namespace {

constexpr std::size_t cosineCount = layout::energyCosines;
constexpr std::size_t roughnessCount = layout::energyRoughnesses;
constexpr std::size_t azimuthSteps = 32; // over half a turn; the other half is symmetric
constexpr std::size_t indexCount = layout::energyIndices;

struct Energy {
    double white = 0.0;
    double grazing = 0.0;
};

using EnergyRow = std::array<Energy, cosineCount>;

/// The midpoints of `azimuthSteps` intervals over half a turn. Sines of leaves would be those of float32.
struct Azimuths : std::array<leaves::SineCosine<double>, azimuthSteps> {
    Azimuths() {
        static_assert(azimuthSteps == 32);
        double c = 0.0; // cosine of a quarter turn, halved to a 128th of a turn, which is half a step
        for (int i = 0; i < 5; ++i)
            c = std::sqrt(0.5 + 0.5 * c);
        const double s = std::sqrt(1.0 - c * c);
        const double stepCosine = c * c - s * s;
        const double stepSine = 2.0 * s * c;
        front() = {s, c};
        for (std::size_t i = 1; i < azimuthSteps; ++i) {
            const auto [sine, cosine] = (*this)[i - 1];
            (*this)[i] = {sine * stepCosine + cosine * stepSine, cosine * stepCosine - sine * stepSine};
        }
    }
};

double fifthPower(double x) { return x * x * (x * x) * x; }

/// Looks at a surface of GGX facets.
struct Viewer {
    double cosine; ///< to the surface's normal
    double alpha;
    glm::dvec3 wo{std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
    double stretch = leaves::stretchOf(wo, alpha);

    [[nodiscard]] glm::dvec3 facetAt(double share, const leaves::SineCosine<double> &azimuth) const {
        return leaves::visibleGgxNormal(wo, glm::dvec2(alpha), azimuth, share);
    }

    /// The share of light from a visible facet to `wi`, on either side, that is not masked.
    [[nodiscard]] double litShare(const glm::dvec3 &wi) const {
        return leaves::smithG2OverG1(cosine, stretch, wi.z, leaves::stretchOf(wi, alpha));
    }
};

/// The ends of the cap contain few facets but matter much, so steps are narrow there.
struct CapStep {
    double share;
    double weight;

    explicit CapStep(double t) : share(t * t * (3.0 - 2.0 * t)), weight(6.0 * t * (1.0 - t)) {}
};

/// How many of the visible facets are lit by what they reflect.
Energy energyOf(double cosine, double alpha, const Azimuths &azimuths) {
    constexpr std::size_t heightSteps = 48;
    const Viewer viewer{cosine, alpha};
    Energy sum;
    double totalWeight = 0.0;
    for (std::size_t k = 0; k < heightSteps; ++k) {
        const CapStep step((static_cast<double>(k) + 0.5) / heightSteps);
        totalWeight += step.weight;
        for (const leaves::SineCosine<double> &azimuth : azimuths) {
            const glm::dvec3 facet = viewer.facetAt(step.share, azimuth);
            const glm::dvec3 wi = leaves::mirrorDirection(-viewer.wo, facet);
            if (wi.z <= 0.0)
                continue;
            const double lit = viewer.litShare(wi);
            sum.white += step.weight * lit;
            sum.grazing +=
                step.weight * lit * fifthPower(1.0 - std::fmin(leaves::dotProduct(viewer.wo, facet), 1.0));
        }
    }
    const double total = totalWeight * static_cast<double>(azimuthSteps);
    return {sum.white / total, sum.grazing / total}; // at most 1
}

/// The share of light that visible facets of glass reflect and refract; `eta` is the index before them divided by the
/// one beyond. Heights of different azimuths differ, by the golden ratio, as total reflection begins at one height
/// where the viewer is above.
double glassEnergyOf(double cosine, double alpha, double eta, const Azimuths &azimuths) {
    constexpr std::size_t heightSteps = 20;
    constexpr double goldenStep = 0.6180339887498949;
    const Viewer viewer{cosine, alpha};
    double sum = 0.0;
    double totalWeight = 0.0;
    for (std::size_t i = 0; i < azimuthSteps; ++i) {
        const double turns = (static_cast<double>(i) + 0.5) * goldenStep;
        const double offset = turns - std::floor(turns);
        for (std::size_t k = 0; k < heightSteps; ++k) {
            const CapStep step((static_cast<double>(k) + offset) / heightSteps);
            totalWeight += step.weight;
            const glm::dvec3 facet = viewer.facetAt(step.share, azimuths[i]);
            const auto glass = leaves::fresnelDielectric(-viewer.wo, facet, eta);
            if (glass.reflectance < 1.0 && glass.refracted.z < 0.0)
                sum += step.weight * (1.0 - glass.reflectance) * viewer.litShare(glass.refracted);
            const glm::dvec3 reflected = leaves::mirrorDirection(-viewer.wo, facet);
            if (reflected.z > 0.0)
                sum += step.weight * glass.reflectance * viewer.litShare(reflected);
        }
    }
    return sum / totalWeight;
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

namespace {

/// The eta of a node of the first half of layers, whose light comes from the thinner side.
double etaOfNode(std::size_t node) {
    const double place = static_cast<double>(node) / static_cast<double>(indexCount - 1);
    const double contrast = std::fmax(place * place, 1e-7) * (9.0 / 11.0); // at 1 both sides differ
    return (1.0 - contrast) / (1.0 + contrast);
}

/// Marks the nodes of the cells that `least` to `most` fall into, and of their neighbours where rounding may decide.
template <std::size_t count>
void markNodes(std::bitset<count> &nodes, std::size_t first, std::size_t last, double least, double most) {
    constexpr double margin = 0.01;
    for (std::size_t node = first; node <= last; ++node) {
        const auto place = static_cast<double>(node - first);
        if (place > least - 1.0 - margin && place < most + 1.0 + margin)
            nodes.set(node);
    }
}

} // namespace

void GlassNodes::addIndices(const IndexSpan &before, const IndexSpan &beyond) {
    const double least = before.least / beyond.most;
    const double most = before.most / beyond.least;
    const auto placeOf = [](double eta) {
        return leaves::indexPosition<double>(eta) * static_cast<double>(indexCount - 1);
    };
    if (least < 1.0)
        markNodes(layers, 0, indexCount - 1, placeOf(std::min(most, 1.0)), placeOf(least));
    if (most > 1.0)
        markNodes(layers, indexCount, 2 * indexCount - 1, placeOf(std::max(least, 1.0)), placeOf(most));
}

void GlassNodes::addRoughness(double least, double most) {
    const auto last = static_cast<double>(roughnessCount - 1);
    markNodes(roughnesses, 0, roughnessCount - 1, least * last, most * last);
}

std::vector<layout::LookupRow> makeGlassTexels(const GlassNodes &nodes) {
    const Azimuths azimuths;
    // By layer, roughness, cosine.
    std::vector<float> energies(2 * indexCount * roughnessCount * cosineCount, 1.0f);
#pragma omp parallel for schedule(dynamic) collapse(2)
    for (std::size_t layer = 0; layer < 2 * indexCount; ++layer)
        for (std::size_t j = 1; j < roughnessCount; ++j) { // smooth glass loses nothing
            if (!nodes.layers[layer] || !nodes.roughnesses[j])
                continue;
            const double thin = etaOfNode(layer % indexCount);
            const double eta = layer < indexCount ? thin : 1.0 / thin;
            const double roughness = static_cast<double>(j) / static_cast<double>(roughnessCount - 1);
            for (std::size_t i = 0; i < cosineCount; ++i) {
                const double root = static_cast<double>(i) / static_cast<double>(cosineCount - 1);
                energies[(layer * roughnessCount + j) * cosineCount + i] =
                    static_cast<float>(glassEnergyOf(root * root, roughness * roughness, eta, azimuths));
            }
        }
    std::vector<layout::LookupRow> texels;
    texels.reserve(layout::glassTexelCount);
    for (std::size_t layer = 0; layer < 2 * indexCount; ++layer)
        for (std::size_t j = 0; j + 1 < roughnessCount; ++j)
            for (std::size_t i = 0; i + 1 < cosineCount; ++i) {
                const float *const low = &energies[(layer * roughnessCount + j) * cosineCount + i];
                const float *const high = low + cosineCount;
                texels.push_back({glm::vec3(low[0], low[1], high[0]), std::bit_cast<std::uint32_t>(high[1])});
            }
    return texels;
}

double averageConductorReflectance(double index, double extinction) {
    constexpr int steps = 1024;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        sum += leaves::conductorReflectance<double>(cosine, index, extinction) * cosine;
    }
    return 2.0 * sum / steps;
}

} // namespace hyalite::core
