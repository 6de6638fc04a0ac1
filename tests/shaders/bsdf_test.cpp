// BSDFs: energy, reciprocity, and directions with the density that they say they have.
#include "tests/fixtures/bsdf_fixture.h"

#include "host/packing/microfacet_energy.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>

namespace hyalite::core::reference {
namespace {

TEST(MicrofacetEnergy, TheTableIsWhatFacetsReflectAtOnce) {
    // At nodes and between them, by the reference's own facets, drawn at random.
    Random random(601);
    for (int i = 0; i < 12; ++i) {
        const double roughness = random.uniform(0.05, 1.0);
        const double cosine = random.uniform(0.02, 1.0);
        const double alpha = roughness * roughness;
        const Direction view = viewAt(cosine);
        const double stretch = stretchOf(view, alpha);
        constexpr int count = 400000;
        double white = 0.0;
        double grazing = 0.0;
        for (int k = 0; k < count; ++k) {
            const double x = random.uniform(0.0, 1.0);
            const Direction facet = sampleGgxVndf(view, alpha, Vec2<double>(x, random.uniform(0.0, 1.0)));
            const Direction light = mirrorDirection<double>(-view, facet);
            if (light.z <= 0.0)
                continue;
            const double lit = smithG2OverG1(view.z, stretch, light.z, stretchOf(light, alpha));
            white += lit;
            grazing += lit * std::pow(1.0 - dotProduct(view, facet), 5.0);
        }
        const Energy<double> found = energyOf(scene, cosine, roughness);
        EXPECT_NEAR(found.white, white / count, 2.5e-3) << roughness << ", " << cosine;
        EXPECT_NEAR(found.grazing, grazing / count, 2.5e-3) << roughness << ", " << cosine;
    }
}

TEST(MicrofacetEnergy, AveragesAreThoseOfTheTable) {
    for (const double roughness : {0.1, 0.37, 0.8, 1.0}) {
        constexpr int steps = 20000;
        double white = 0.0;
        double grazing = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double cosine = (i + 0.5) / steps;
            const Energy<double> energy = energyOf(scene, cosine, roughness);
            white += 2.0 * energy.white * cosine / steps;
            grazing += 2.0 * energy.grazing * cosine / steps;
        }
        const Energy<double> average = averageEnergy(scene, roughness);
        EXPECT_NEAR(average.white, white, 1e-6);
        EXPECT_NEAR(average.grazing, grazing, 1e-6);
    }
}

TEST(Conductors, ReflectAsTheirComplexIndexSays) {
    // Head on: ((n-1)^2 + k^2) / ((n+1)^2 + k^2); along the surface everything.
    EXPECT_NEAR(conductorReflectance(1.0, 0.2, 3.4), (0.64 + 11.56) / (1.44 + 11.56), 1e-12);
    EXPECT_NEAR(conductorReflectance(0.0, 0.2, 3.4), 1.0, 1e-12);
    // Without extinction it is glass.
    const Direction normal(0, 0, 1);
    for (const double cosine : {0.1, 0.5, 0.9})
        EXPECT_NEAR(conductorReflectance(cosine, 1.5, 0.0),
                    fresnelDielectric<double>(-viewAt(cosine), normal, 1.0 / 1.5).reflectance, 1e-12);
    double average = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const double cosine = (i + 0.5) / 4000.0;
        average += 2.0 * conductorReflectance(cosine, 1.2, 2.3) * cosine / 4000.0;
    }
    EXPECT_NEAR(averageConductorReflectance(1.2, 2.3), average, 1e-5);
}

TEST(RoughFurnace, AWhiteMetalReflectsEverything) {
    for (const double roughness : {0.05, 0.2, 0.5, 0.8, 1.0})
        for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
            const Albedo found = albedoOf(whiteMetal(roughness * roughness), viewAt(cosine), 602);
            EXPECT_NEAR(found.mean, 1.0, 2.5e-3 + 4.0 * found.error) << roughness << ", " << cosine;
        }
}

/// albedoOf() by evenly spread points, for lobes that are smooth: the fractional parts of multiples of powers of the
/// root of x^5 = x + 1, Roberts' sequence.
double evenAlbedoOf(const layout::MaterialRecord &material, const Direction &view, double eta) {
    constexpr int count = 20000;
    constexpr double root = 1.1673039782614187;
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        std::array<double, 4> point;
        double step = 1.0;
        for (double &x : point) {
            step /= root;
            x = 0.5 + i * step - std::floor(0.5 + i * step);
        }
        const Bsdf<double> rough = seenFrom(material, view, point[0], eta);
        const Direction light = sampleBsdf(scene, rough, Vec2<double>(point[1], point[2]), point[3]);
        const BsdfEval<double> scattered = evalBsdf(scene, rough, light);
        if (scattered.pdf > 0.0)
            sum += scattered.value.x / scattered.pdf / (light.z < 0.0 ? eta * eta : 1.0);
    }
    return sum / count;
}

TEST(RoughFurnace, NoMaterialReflectsMoreThanThereIs) {
    Random random(603);
    const auto share = [&] { return static_cast<float>(random.uniform(0.0, 1.0)); };
    for (int i = 0; i < 400; ++i) {
        const double roughness = random.uniform(0.04, 1.0);
        layout::MaterialRecord material =
            principled(roughness * roughness, i % 3 == 0 ? share() : 0.0f, 1.0f);
        material.normalReflectance = i % 2 == 0 ? 0.04f : share();
        if (i % 5 < 3)
            material.clearcoat = i % 5 == 0 ? 1.0f : share();
        else if (i % 5 == 3)
            material.transmission = share();
        material.clearcoatAlpha = static_cast<float>(std::pow(random.uniform(0.04, 1.0), 2.0));
        const double cosine = i % 4 == 0 ? random.uniform(0.01, 0.1) : random.uniform(0.1, 1.0);
        const double eta = i % 2 == 0 ? random.uniform(1.1, 2.4) : 1.0 / random.uniform(1.1, 2.4);
        const double found = evenAlbedoOf(material, viewAt(cosine), eta);
        EXPECT_LT(found, cosine < 0.1 ? 1.008 : 1.003) << i << ": " << roughness << ", " << cosine;
        EXPECT_GT(found, cosine < 0.1 ? 0.99 : 0.997) << i << ": " << roughness << ", " << cosine;
    }
}

TEST(RoughFurnace, ACoatTakesNothingFromWhite) {
    for (const double roughness : {0.05, 0.4, 1.0})
        for (const double clearcoatRoughness : {0.04, 0.1, 0.5, 1.0})
            for (const double cosine : {0.05, 0.2, 0.6, 1.0})
                for (const float metallic : {0.0f, 1.0f}) {
                    layout::MaterialRecord material = principled(roughness * roughness, metallic, 1.0f, 1.0f);
                    material.clearcoatAlpha = static_cast<float>(clearcoatRoughness * clearcoatRoughness);
                    EXPECT_NEAR(evenAlbedoOf(material, viewAt(cosine), 1.0 / 1.5), 1.0,
                                cosine < 0.1 ? 5e-3 : 2e-3)
                        << roughness << ", " << clearcoatRoughness << ", " << cosine << ", " << metallic;
                }
}

TEST(RoughFurnace, GlassReflectsAndPassesEverything) {
    for (const double index : {1.1, 1.2, 1.5, 1.9, 2.4})
        for (const double eta : {index, 1.0 / index})
            for (const double roughness : {0.05, 0.3, 0.55, 0.8, 1.0})
                for (const double cosine : {0.03, 0.2, 0.6, 1.0}) {
                    const double found =
                        evenAlbedoOf(frostedGlass(roughness * roughness), viewAt(cosine), eta);
                    EXPECT_GT(found, cosine < 0.1 ? 0.98 : 0.99)
                        << eta << ", " << roughness << ", " << cosine;
                    EXPECT_LT(found, cosine < 0.1 ? 1.02 : 1.01)
                        << eta << ", " << roughness << ", " << cosine;
                }
}

TEST(RoughFurnace, GlassOfEveryIndexDoes) {
    for (const double index : {1.0001, 1.01, 3.0, 6.0, 10.0})
        for (const double eta : {index, 1.0 / index})
            for (const double roughness : {0.1, 0.5, 1.0})
                for (const double cosine : {0.2, 0.6, 1.0})
                    EXPECT_NEAR(evenAlbedoOf(frostedGlass(roughness * roughness), viewAt(cosine), eta), 1.0,
                                0.015)
                        << eta << ", " << roughness << ", " << cosine;
}

TEST(RoughFurnace, PrincipledGlassDoes) {
    layout::MaterialRecord material = principled(0.49, 0.0f, 1.0f);
    material.transmission = 1.0f;
    for (const double eta : {1.5, 1.0 / 1.5})
        for (const double cosine : {0.2, 0.6, 1.0})
            EXPECT_NEAR(evenAlbedoOf(material, viewAt(cosine), eta), 1.0, 0.01) << eta << ", " << cosine;
}

/// What a ball of rough glass in white light sends to an eye far away, averaged over its disc. A chord meets the sphere
/// at the angle at which it left it, so that cosines are all there is to follow.
Albedo ballOf(double index, double roughness, std::uint64_t seed) {
    constexpr int count = 100000;
    constexpr int maxSegments = 4000;
    Random random(seed);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < count; ++i) {
        double throughput = 1.0;
        bool isInside = false;
        double cosine = std::sqrt(random.uniform(0.0, 1.0)); // of even points of the disc
        for (int segment = 0; segment < maxSegments; ++segment) {
            const double eta = isInside ? index : 1.0 / index;
            const Bsdf<double> rough =
                seenFrom(frostedGlass(roughness * roughness), viewAt(cosine), 0.5, eta);
            const double x = random.uniform(0.0, 1.0);
            const Direction light =
                sampleBsdf(scene, rough, Vec2<double>(x, random.uniform(0.0, 1.0)), random.uniform(0.0, 1.0));
            const BsdfEval<double> scattered = evalBsdf(scene, rough, light);
            if (scattered.pdf <= 0.0) {
                throughput = 0.0;
                break;
            }
            throughput *= scattered.value.x / scattered.pdf / (light.z < 0.0 ? eta * eta : 1.0);
            isInside = isInside == (light.z > 0.0);
            if (!isInside)
                break;
            const double survival = std::min(throughput, 1.0); // Russian roulette
            if (random.uniform(0.0, 1.0) >= survival) {
                throughput = 0.0;
                break;
            }
            throughput /= survival;
            cosine = std::min(std::abs(light.z), 1.0);
        }
        sum += throughput;
        squares += throughput * throughput;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count)};
}

TEST(RoughFurnace, ABallOfGlassIsInvisible) {
    for (const double index : {1.1, 1.5, 2.0, 2.4})
        for (const double roughness : {0.1, 0.35, 0.6, 1.0}) {
            const Albedo found = ballOf(index, roughness, 612);
            EXPECT_NEAR(found.mean, 1.0, 0.01 + 3.0 * found.error) << index << ", " << roughness;
            EXPECT_LT(found.error, 0.02);
        }
}

TEST(GlassEnergy, OfTheNodesThatASceneNeedsIsThatOfAll) {
    const std::array<double, 3> indices{1.0, 1.33, 2.4};
    PackedScene packed;
    packed.lookups = makeEnergyTexels();
    GlassNodes nodes;
    nodes.addRoughness(0.3, 0.45);
    for (const double before : indices)
        for (const double beyond : indices)
            nodes.addIndices({before, before}, {beyond, beyond});
    std::ranges::copy(makeGlassTexels(nodes), std::back_inserter(packed.lookups));
    EXPECT_LT(nodes.roughnesses.count(), 9u);
    EXPECT_LT(nodes.layers.count(), 15u);
    const SceneView<float> some(packed);
    const SceneView<float> all(sceneOfAllMaterials());
    Random random(611);
    for (int i = 0; i < 3000; ++i) {
        const double x = random.uniform(0.0, 1.0);
        const double roughness = i % 8 == 0 ? 0.3 : i % 8 == 1 ? 0.45 : random.uniform(0.3, 0.45);
        for (const double before : indices)
            for (const double beyond : indices)
                if (before != beyond) {
                    const float eta = static_cast<float>(before) / static_cast<float>(beyond);
                    const float cosine = static_cast<float>(x);
                    const float rough = static_cast<float>(roughness);
                    ASSERT_EQ(glassEnergy(some, cosine, rough, eta), glassEnergy(all, cosine, rough, eta));
                }
    }
}

TEST(RoughReciprocity, LightGoesBothWaysAlike) {
    Random random(606);
    const auto direction = [&] {
        Direction d(random.direction());
        d.z = std::abs(d.z) + 0.01;
        return unitVector(d);
    };
    for (int i = 0; i < 2000; ++i) {
        const double alpha = random.uniform(0.01, 1.0);
        const Direction a = direction();
        const Direction b = direction();
        const float metallic = static_cast<float>(random.uniform(0.0, 1.0));
        for (const layout::MaterialRecord &material :
             {conductor(alpha, 0.3f, 2.5f), principled(alpha, metallic, 0.6f)}) {
            const double forth =
                evalBsdf(scene, seenFrom(material, a), toLocal(seenFrom(material, a).frame, b)).value.x / b.z;
            const double back =
                evalBsdf(scene, seenFrom(material, b), toLocal(seenFrom(material, b).frame, a)).value.x / a.z;
            ASSERT_NEAR(forth / back, 1.0, 1e-6) << "alpha " << alpha;
        }
        // Through an interface radiance grows by the square of the index. That differs, and what the energy of glass
        // gives back, which is that of the viewer.
        const Direction below(b.x, b.y, -b.z);
        const Bsdf<double> fromAbove = seenFrom(frostedGlass(alpha), a, 0.5, 1.0 / 1.5);
        const double through = evalBsdf(scene, fromAbove, below).value.x / b.z *
                               glassEnergy(scene, a.z, std::sqrt(alpha), 1.0 / 1.5);
        const Bsdf<double> fromBelow = seenFrom(frostedGlass(alpha), b, 0.5, 1.5);
        const double back = evalBsdf(scene, fromBelow, Direction(a.x, a.y, -a.z)).value.x / a.z *
                            glassEnergy(scene, b.z, std::sqrt(alpha), 1.5);
        if (through > 1e-12) {
            ASSERT_NEAR(through * 2.25 / back, 1.0, 1e-5) << "alpha " << alpha;
        }
    }
}

TEST(RoughDensity, IsThatOfTheDirectionsDrawn) {
    for (const double cosine : {0.15, 0.7, 1.0})
        for (const double alpha : {0.25, 1.0}) {
            const Direction view = viewAt(cosine);
            EXPECT_LT(chiSquareOf(seenFrom(conductor(alpha, 0.3f, 2.5f), view), 607), 4.5)
                << alpha << ", " << cosine;
            EXPECT_LT(chiSquareOf(seenFrom(principled(alpha, 0.0f, 0.5f), view), 608), 4.5)
                << alpha << ", " << cosine;
            EXPECT_LT(chiSquareOf(seenFrom(frostedGlass(alpha), view), 609), 4.5) << alpha << ", " << cosine;
            EXPECT_LT(chiSquareOf(seenFrom(frostedGlass(alpha), view, 0.5, 1.5), 610), 4.5)
                << alpha << ", " << cosine;
        }
}

TEST(PrincipledMaterial, ItsComponentsAreChosenByTheirShares) {
    layout::MaterialRecord material = principled(0.25, 0.25f, 0.5f);
    material.transmission = 0.5f;
    int glassCount = 0;
    for (int i = 0; i < 1000; ++i)
        glassCount += seenFrom(material, viewAt(0.8), (i + 0.5) / 1000.0).kind == bsdfGlass;
    EXPECT_EQ(glassCount, 375); // of what is no metal, the half
    EXPECT_EQ(seenFrom(material, viewAt(0.8), 0.99, 1.5, true).kind, bsdfGlass) << "from inside";
}

} // namespace
} // namespace hyalite::core::reference
