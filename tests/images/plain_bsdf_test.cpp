// The plain path tracer itself: its BSDFs, what they are made of, and both of its ways to find emitters.
#include "tests/images/plain_bsdf.h"
#include "tests/images/plain_comparison.h"
#include "tests/images/plain_scenes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace hyalite::core::testing::plain {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint64_t seed = 3;

/// A BSDF and a viewer.
struct Sight {
    std::string name;
    Material material;
    double indexRatio;
    double viewCosine;

    [[nodiscard]] Bsdf bsdf() const {
        TestScene scene;
        scene.materials = {material};
        const Substances substances(scene);
        return {substances.at(0, Vec2(0.0)), indexRatio, false};
    }
    [[nodiscard]] Vec view() const {
        const double sine = std::sqrt(1.0 - viewCosine * viewCosine);
        return {0.8 * sine, 0.6 * sine, viewCosine};
    }
};

void PrintTo(const Sight &sight, std::ostream *stream) { *stream << sight.name; }

Sight sight(const std::string &name, MaterialKind kind, float roughness, double viewCosine,
            double indexRatio = 1.0) {
    Material material;
    material.kind = kind;
    material.roughness = roughness;
    material.albedo = {0.8f, 0.5f, 0.3f};
    return {name, material, indexRatio, viewCosine};
}

std::vector<Sight> sights() {
    std::vector<Sight> all = {
        sight("Diffuse", MaterialKind::Diffuse, 0.0f, 0.7),
        sight("Conductor", MaterialKind::Conductor, 0.6f, 0.8),
        sight("GrazingConductor", MaterialKind::Conductor, 0.8f, 0.2),
        sight("GlassFromOutside", MaterialKind::Dielectric, 0.6f, 0.7, 1.0 / 1.5),
        sight("GlassFromInside", MaterialKind::Dielectric, 0.6f, 0.7, 1.5),
        sight("GrazingGlass", MaterialKind::Dielectric, 0.7f, 0.3, 1.0 / 2.0),
        sight("Plastic", MaterialKind::Principled, 0.6f, 0.6),
        sight("Lacquer", MaterialKind::Principled, 0.8f, 0.5),
        sight("Everything", MaterialKind::Principled, 0.7f, 0.6, 1.0 / 1.5),
    };
    all[7].material.clearcoat = 1.0f;
    all[7].material.clearcoatRoughness = 0.6f;
    all[8].material.metallic = 0.3f;
    all[8].material.transmission = 0.6f;
    return all;
}

class PlainBsdf : public ::testing::TestWithParam<Sight> {};

INSTANTIATE_TEST_SUITE_P(All, PlainBsdf, ::testing::ValuesIn(sights()),
                         [](const auto &instance) { return instance.param.name; });

/// Of one lobe, which is what reciprocity can be asked of.
std::vector<Sight> sightsOfOneLobe() {
    std::vector<Sight> some = sights();
    std::erase_if(some, [](const Sight &each) {
        return each.material.transmission > 0.0f || each.material.clearcoat > 0.0f;
    });
    return some;
}

class ReciprocalBsdf : public PlainBsdf {};

INSTANTIATE_TEST_SUITE_P(All, ReciprocalBsdf, ::testing::ValuesIn(sightsOfOneLobe()),
                         [](const auto &instance) { return instance.param.name; });

constexpr int rowCount = 16;    // of bins, even in the cosine
constexpr int columnCount = 16; // even in the azimuth

/// Integral of f over directions of one bin, by midpoints.
double integrate(const std::function<double(const Vec &)> &f, int row, int column) {
    constexpr int steps = 24;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = 2.0 * (row + (i + 0.5) / steps) / rowCount - 1.0;
            const double turn = 2.0 * pi * (column + (j + 0.5) / steps) / columnCount;
            const double sine = std::sqrt(1.0 - z * z);
            sum += f({sine * std::cos(turn), sine * std::sin(turn), z});
        }
    return sum * 4.0 * pi / (rowCount * columnCount * steps * steps);
}

// Pearson's chi-square test of samples in bins of directions.
TEST_P(PlainBsdf, DrawsDirectionsWithItsDensity) {
    const Bsdf bsdf = GetParam().bsdf();
    const Vec view = GetParam().view();
    constexpr int count = 200'000;
    std::vector<int> found(rowCount * columnCount, 0);
    Generator generator(seed);
    for (int i = 0; i < count; ++i)
        if (const std::optional<Vec> light = bsdf.sample(view, generator)) {
            const int row = std::min(static_cast<int>((light->z + 1.0) / 2.0 * rowCount), rowCount - 1);
            const double turn = std::atan2(light->y, light->x) / (2.0 * pi);
            const int column =
                std::min(static_cast<int>((turn < 0.0 ? turn + 1.0 : turn) * columnCount), columnCount - 1);
            ++found[static_cast<std::size_t>(row * columnCount + column)];
        }
    double chiSquare = 0.0;
    int binCount = 0;
    for (int row = 0; row < rowCount; ++row)
        for (int column = 0; column < columnCount; ++column) {
            const double expected =
                count * integrate([&](const Vec &light) { return bsdf.density(view, light); }, row, column);
            const double difference = found[static_cast<std::size_t>(row * columnCount + column)] - expected;
            if (expected < 20.0) {
                EXPECT_LT(std::abs(difference), 30.0) << "row " << row << ", column " << column;
                continue;
            }
            chiSquare += difference * difference / expected;
            ++binCount;
        }
    ASSERT_GT(binCount, 60);
    // For many degrees of freedom the square root of twice chi-square is normally distributed (Fisher).
    EXPECT_LT(std::sqrt(2.0 * chiSquare) - std::sqrt(2.0 * binCount - 1.0), 4.0) << "seed " << seed;
}

// What samples say of the light that is reflected and passed is what quadrature says.
TEST_P(PlainBsdf, IsSampledWithoutBias) {
    const Bsdf bsdf = GetParam().bsdf();
    const Vec view = GetParam().view();
    double expected = 0.0;
    for (int row = 0; row < rowCount; ++row)
        for (int column = 0; column < columnCount; ++column)
            expected +=
                integrate([&](const Vec &light) { return bsdf.evaluate(view, light).x; }, row, column);
    constexpr int count = 200'000;
    double sum = 0.0;
    double squares = 0.0;
    Generator generator(seed);
    for (int i = 0; i < count; ++i)
        if (const std::optional<Vec> light = bsdf.sample(view, generator)) {
            const double weight = bsdf.evaluate(view, *light).x / bsdf.density(view, *light);
            sum += weight;
            squares += weight * weight;
        }
    const double mean = sum / count;
    const double error = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_LT(error, 0.01 * expected);
    EXPECT_NEAR(mean, expected, 4.0 * error + 1e-3 * expected) << "seed " << seed;
}

// Glass gives back what facets send to each other by the viewer's energy: without that it is reciprocal.
TEST_P(ReciprocalBsdf, ReflectsAlikeBothWays) {
    const Material &material = GetParam().material;
    const Bsdf bsdf = GetParam().bsdf();
    const Vec a = GetParam().view();
    Generator generator(seed);
    const auto energyOf = [&](const Vec &view) {
        return material.kind == MaterialKind::Dielectric
                   ? glassEnergy(view.z, material.roughness, GetParam().indexRatio)
                   : 1.0;
    };
    for (int i = 0; i < 1000; ++i) {
        const double z = 0.02 + 0.98 * uniform(generator);
        const double turn = 2.0 * pi * uniform(generator);
        const Vec b(std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z);
        const Vec there = bsdf.evaluate(a, b) / b.z * energyOf(a);
        const Vec back = bsdf.evaluate(b, a) / a.z * energyOf(b);
        for (glm::length_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(there[channel], back[channel], 1e-9 * there[channel]);
    }
}

// Metal that reflects everything, and plastic whose colour is white, lose nothing, whatever their roughness.
TEST(PlainFurnace, WhiteMetalAndPlasticReflectEverything) {
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float roughness : {0.5f, 0.75f, 1.0f})
            for (const double viewCosine : {0.25, 0.6, 1.0}) {
                Sight white = sight("White", MaterialKind::Principled, roughness, viewCosine);
                white.material.albedo = glm::vec3(1.0f);
                white.material.metallic = metallic;
                const Bsdf bsdf = white.bsdf();
                double sum = 0.0;
                for (int row = 0; row < rowCount; ++row)
                    for (int column = 0; column < columnCount; ++column)
                        sum +=
                            integrate([&](const Vec &light) { return bsdf.evaluate(white.view(), light).y; },
                                      row, column);
                EXPECT_NEAR(sum, 1.0, 2e-3)
                    << "metallic " << metallic << ", roughness " << roughness << ", cosine " << viewCosine;
            }
}

// At roughness 0.04 rough glass is nearly smooth: what it reflects and passes is Fresnel's share, by the squared index.
TEST(PlainFurnace, PolishedGlassFollowsFresnel) {
    for (const double indexRatio : {1.0 / 1.5, 1.3})
        for (const double viewCosine : {0.9, 0.7}) {
            const Sight polished = sight("Polished", MaterialKind::Dielectric, 0.04f, viewCosine, indexRatio);
            const Bsdf bsdf = polished.bsdf();
            Generator generator(seed);
            constexpr int count = 100'000;
            double reflected = 0.0;
            double passed = 0.0;
            for (int i = 0; i < count; ++i)
                if (const std::optional<Vec> light = bsdf.sample(polished.view(), generator))
                    (light->z > 0.0 ? reflected : passed) += bsdf.evaluate(polished.view(), *light).x /
                                                             bsdf.density(polished.view(), *light) / count;
            const double fresnel = dielectricFresnel(viewCosine, indexRatio);
            EXPECT_NEAR(reflected, fresnel, 4.0 * std::sqrt(fresnel / count) + 1e-3);
            EXPECT_NEAR(passed / (indexRatio * indexRatio), 1.0 - fresnel,
                        4.0 * std::sqrt(fresnel / count) + 1e-3);
        }
}

// Glass that is not tinted loses nothing, from either side.
TEST(PlainFurnace, RoughGlassReflectsAndPassesEverything) {
    for (const double indexRatio : {1.0 / 2.4, 1.0 / 1.1, 1.1, 1.5, 2.4})
        for (const float roughness : {0.2f, 0.6f, 1.0f})
            for (const double viewCosine : {0.2, 0.6, 1.0}) {
                const Sight rough =
                    sight("Rough", MaterialKind::Dielectric, roughness, viewCosine, indexRatio);
                const Bsdf bsdf = rough.bsdf();
                Generator generator(seed);
                constexpr int count = 100'000;
                double sum = 0.0;
                double squares = 0.0;
                for (int i = 0; i < count; ++i)
                    if (const std::optional<Vec> light = bsdf.sample(rough.view(), generator)) {
                        const double radiance = light->z > 0.0 ? 1.0 : 1.0 / (indexRatio * indexRatio);
                        const double value = radiance * bsdf.evaluate(rough.view(), *light).x /
                                             bsdf.density(rough.view(), *light);
                        sum += value;
                        squares += value * value;
                    }
                const double mean = sum / count;
                EXPECT_NEAR(mean, 1.0, 4.0 * std::sqrt((squares / count - mean * mean) / count) + 1e-3)
                    << "index ratio " << indexRatio << ", roughness " << roughness << ", cosine "
                    << viewCosine;
            }
}

TEST(PlainFresnel, HasItsClosedForms) {
    for (const double n : {1.2, 1.5, 2.4}) {
        const double headOn = std::pow((n - 1.0) / (n + 1.0), 2.0);
        EXPECT_NEAR(dielectricFresnel(1.0, 1.0 / n), headOn, 1e-15);
        EXPECT_NEAR(dielectricFresnel(1.0, n), headOn, 1e-15);
        EXPECT_NEAR(conductorFresnel(1.0, n, 0.0), headOn, 1e-15);
        // At Brewster's angle, whose tangent is n, one polarisation is not reflected.
        const double brewster = 1.0 / std::sqrt(1.0 + n * n);
        const double other = (1.0 - n * n) / (1.0 + n * n);
        EXPECT_NEAR(dielectricFresnel(brewster, 1.0 / n), 0.5 * other * other, 1e-15);
        EXPECT_NEAR(conductorFresnel(brewster, n, 0.0), 0.5 * other * other, 1e-15);
        // Beyond the critical angle everything is.
        const double critical = std::sqrt(1.0 - 1.0 / (n * n));
        EXPECT_EQ(dielectricFresnel(critical - 1e-6, n), 1.0);
        EXPECT_LT(dielectricFresnel(critical + 1e-6, n), 1.0);
        // By reversal of light both sides reflect alike.
        EXPECT_NEAR(dielectricFresnel(0.6, 1.0 / n), dielectricFresnel(std::sqrt(1.0 - 0.64 / (n * n)), n),
                    1e-12);
    }
    const double n = 0.2;
    const double k = 3.6;
    EXPECT_NEAR(conductorFresnel(1.0, n, k),
                ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k), 1e-15);
}

// The area of facets that are seen is that of the surface: Heitz 2014, equation 14, and for the viewer above, equation
// 5.
TEST(PlainFacets, CoverTheSurface) {
    for (const double alpha : {0.1, 0.4, 1.0}) {
        const auto distributed = [&](const Vec &m) { return m.z > 0.0 ? ggx(m, alpha) * m.z : 0.0; };
        double sum = 0.0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double z = (i + 0.5) / steps;
            sum += distributed({std::sqrt(1.0 - z * z), 0.0, z}) * 2.0 * pi / steps;
        }
        EXPECT_NEAR(sum, 1.0, 1e-3);
    }
}

TEST(PlainFacets, HaveConvergedEnergies) {
    for (const double roughness : {0.1, 0.37, 0.8, 1.0})
        for (const double cosine : {0.05, 0.3, 0.62, 1.0}) {
            const Energy exact = integrateEnergy(cosine, roughness * roughness, 512);
            const Energy used = directionalEnergy(cosine, roughness);
            EXPECT_NEAR(used.white, exact.white, cosine < 0.1 ? 2e-3 : 2e-4)
                << "roughness " << roughness << ", cosine " << cosine;
            EXPECT_NEAR(used.grazing, exact.grazing, cosine < 0.1 ? 2e-3 : 2e-4)
                << "roughness " << roughness << ", cosine " << cosine;
        }
}

TEST(PlainFacets, HaveConvergedEnergiesOfGlass) {
    for (const double indexRatio : {1.0 / 2.2, 1.0 / 1.1, 1.1, 1.5, 2.4})
        for (const double roughness : {0.1, 0.37, 0.8, 1.0})
            for (const double cosine : {0.05, 0.3, 0.62, 1.0})
                EXPECT_NEAR(glassEnergy(cosine, roughness, indexRatio),
                            integrateGlassEnergy(cosine, roughness * roughness, indexRatio, 512),
                            cosine < 0.1 ? 2e-3 : 1e-3)
                    << "index ratio " << indexRatio << ", roughness " << roughness << ", cosine " << cosine;
}

TEST(PlainPathTracer, FindsTheSameLightByAimingAndByScattering) {
    TestScene scene = emptyScene(4);
    Material metal = diffuse(glm::vec3(0.5f));
    metal.kind = MaterialKind::Conductor;
    metal.roughness = 0.6f;
    Material glass = diffuse(glm::vec3(1.0f));
    glass.kind = MaterialKind::Dielectric;
    glass.roughness = 0.7f;
    addBall(scene, {-0.5, -0.4, 0.0}, 0.6, metal);
    addBall(scene, {0.6, -0.4, 0.2}, 0.5, glass);
    addQuad(scene, {-3.0f, -1.0f, 3.0f}, {6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, diffuse(glm::vec3(0.6f)));
    addQuad(scene, {-3.0f, 2.0f, 3.0f}, {0.0f, 0.0f, -6.0f}, {6.0f, 0.0f, 0.0f}, lamp(glm::vec3(1.0f)));
    addBall(scene, {0.0, 0.9, -1.0}, 0.4, lamp(glm::vec3(3.0f)));
    const Estimate aimed = estimatePlainly(scene, 0, 16, 4, 16, 500'000, seed, Search::ByAiming);
    const Estimate scattered = estimatePlainly(scene, 0, 16, 4, 16, 500'000, seed + 1, Search::ByScattering);
    const double error = std::sqrt(aimed.variance.x + scattered.variance.x);
    EXPECT_LT(error, 0.01 * aimed.mean.x);
    EXPECT_NEAR(aimed.mean.x, scattered.mean.x, 4.0 * error);
}

// In a white world clear glass is as bright as what is around it, and a matt ball as its albedo.
TEST(PlainPathTracer, IsAFurnace) {
    TestScene scene = emptyScene(32);
    scene.background = glm::vec3(1.0f);
    Material glass = diffuse(glm::vec3(1.0f));
    glass.kind = MaterialKind::Dielectric;
    addBall(scene, {0.0, 0.0, 0.0}, 1.0, glass);
    const Estimate clear = estimatePlainly(scene, 4, 12, 4, 12, 50'000, seed);
    EXPECT_NEAR(clear.mean.x, 1.0, 1e-6);
    scene.materials[0] = diffuse({0.25f, 0.5f, 0.75f});
    const Estimate matt = estimatePlainly(scene, 4, 12, 4, 12, 50'000, seed);
    EXPECT_NEAR(matt.mean.x, 0.25, 1e-6);
    EXPECT_NEAR(matt.mean.z, 0.75, 1e-6);
}

} // namespace
} // namespace hyalite::core::testing::plain
