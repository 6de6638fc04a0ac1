// Dispersion: indices follow Abbe's number, and light of all waves together is white.
#include "host/packing/packed_scene.h"
#include "tests/fixtures/bsdf_fixture.h"

#include <gtest/gtest.h>

#include <utility>

namespace hyalite::core::reference {
namespace {

constexpr double wavelengthF = 0.48613; // micrometres: lines of hydrogen, of helium, and of hydrogen again
constexpr double wavelengthD = 0.58756;
constexpr double wavelengthC = 0.65627;

layout::MaterialRecord glassOf(float index, float dispersion) {
    Scene made;
    Material &material = made.materials.emplace_back();
    material.kind = MaterialKind::Dielectric;
    material.refractiveIndex = index;
    material.dispersion = dispersion;
    return packScene(made, Bvh{}).materials.at(0);
}

double indexAt(const layout::MaterialRecord &glass, double wavelength) {
    return indexFor<double>(MaterialRecord<double>(glass), waveOf<double>(wavelength).bend);
}

TEST(Dispersion, IsThatOfAbbesNumber) {
    for (const auto &[index, abbe] : {std::pair{1.5168, 64.17}, {1.7847, 25.7}, {2.417, 55.3}}) {
        const layout::MaterialRecord glass =
            glassOf(static_cast<float>(index), static_cast<float>(20.0 / abbe));
        const double spread = indexAt(glass, wavelengthF) - indexAt(glass, wavelengthC);
        EXPECT_NEAR((index - 1.0) / spread, abbe, 1e-3 * abbe);
        EXPECT_NEAR(indexAt(glass, wavelengthD), index, 1e-5);
    }
}

/// What BK7, a crown glass, has by its maker's dispersion formula.
TEST(Dispersion, FollowsAGlassThatIsMeasured) {
    const layout::MaterialRecord crown = glassOf(1.5168f, static_cast<float>(20.0 / 64.17));
    for (const auto &[wavelength, index] :
         {std::pair{0.4047, 1.53024}, {0.4358, 1.52668}, {0.5461, 1.51872}, {0.6438, 1.51472}})
        EXPECT_NEAR(indexAt(crown, wavelength), index, 4e-4) << wavelength;
}

TEST(Dispersion, StaysAmongTheIndicesThereAre) {
    for (const float index : {1.0f, 1.5f, 10.0f})
        for (const double wavelength : {shortestWavelength<double>, longestWavelength<double>}) {
            const double found = indexAt(glassOf(index, 20.0f), wavelength);
            EXPECT_GE(found, 1.0);
            EXPECT_LE(found, 10.0);
        }
}

TEST(Dispersion, OfAllWavesIsWhite) {
    Direction sum(0.0);
    constexpr int count = 300'000;
    for (int i = 0; i < count; ++i) {
        const Wave<double> wave = sampleWave<double>((i + 0.5) / count);
        EXPECT_LE(largestComponent(wave.colour), 3.0 + 1e-9);
        sum = sum + wave.colour;
    }
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(sum[channel] / count, 1.0, 1e-4);
}

// The colours of a rainbow, in their order.
TEST(Dispersion, ShowsARainbow) {
    const auto colour = [](double wavelength) { return waveOf<double>(wavelength).colour; };
    EXPECT_GT(colour(0.64).x, 2.9);                     // red
    EXPECT_GT(colour(0.59).x, colour(0.59).y);          // orange
    EXPECT_NEAR(colour(0.577).x, colour(0.577).y, 0.5); // yellow
    EXPECT_GT(colour(0.53).y, 2.9);                     // green
    EXPECT_NEAR(colour(0.497).y, colour(0.497).z, 0.5); // cyan
    EXPECT_GT(colour(0.465).z, 2.9);                    // blue
    EXPECT_NEAR(colour(0.42).x, 0.727, 0.01);           // violet
    EXPECT_GT(colour(0.42).z, 2.0);
}

} // namespace
} // namespace hyalite::core::reference
