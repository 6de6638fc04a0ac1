// Iridescent films: their colours are those of Airy's formula, they keep energy, and draw directions with the density
// that they say they have. What they look like is judged by the plain path tracer
// (tests/images/plain_materials_test.cpp).
#include "tests/fixtures/bsdf_fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <limits>

namespace hyalite::core::reference {
namespace {

constexpr float washedOut = 20000.0f; // nanometres: no wave of light is told from the next

layout::MaterialRecord filmOn(double alpha, float metallic, float thickness, float index = 1.3f) {
    layout::MaterialRecord material{};
    material.kindAndSides = layout::materialGltf;
    material.alpha = static_cast<float>(alpha);
    material.albedo = glm::vec3(1.0f);
    material.metallic = metallic;
    material.normalReflectance = 0.04f;
    material.dielectricColour = glm::vec3(1.0f);
    material.dielectricWeight = 1.0f;
    material.anisotropyCosine = 1.0f;
    material.iridescence = 1.0f;
    material.iridescenceIndex = index;
    material.iridescenceThickness = thickness;
    return material;
}

layout::MaterialRecord filmOnGlassOf(double alpha, float thickness, float index = 1.3f) {
    layout::MaterialRecord material = filmOn(alpha, 0.0f, thickness, index);
    material.transmission = 1.0f;
    return material;
}

layout::MaterialRecord filmOnThinGlass(double alpha, float thickness) {
    layout::MaterialRecord material = filmOnGlassOf(alpha, thickness);
    material.kindAndSides |= layout::materialIsThin;
    return material;
}

Iridescence<double> filmOf(double index, double thickness, const Direction &bare) {
    layout::MaterialRecord material =
        filmOn(0.01, 1.0f, static_cast<float>(thickness), static_cast<float>(index));
    material.albedo = bare;
    return filmOnOpaque<double>(material, 1.0, Direction(0.04));
}

double schlick(double cosine, double normal) { return normal + (1.0 - normal) * std::pow(1.0 - cosine, 5.0); }

/// The same by Airy's formula, wavelength by wavelength: Born and Wolf, "Principles of Optics", section 7.6. The
/// matching functions are the Gaussians that Belcour and Barla's code has, over waves per metre, and half of the
/// variance is theirs.
Direction byAiry(double index, double thickness, const Direction &bare, double cosine) {
    struct Lobe {
        double height, centre, halfVariance;
    };
    constexpr std::array<Lobe, 4> lobes{{{5.4856e-13, 1.6810e6, 4.3278e9},
                                         {9.7470e-14, 2.2399e6, 4.5282e9},
                                         {4.4201e-13, 1.7953e6, 9.3046e9},
                                         {5.2481e-13, 2.2084e6, 6.6121e9}}};
    constexpr double toRgb[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                    {-0.9692660, 1.8760108, 0.0415560},
                                    {0.0556434, -0.2040259, 1.0572252}};
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    const double upper = schlick(cosine, std::pow((index - 1.0) / (index + 1.0), 2.0));
    Direction sum(0.0);
    Direction white(0.0);
    for (double nanometres = 350.0; nanometres < 900.0; nanometres += 0.5) {
        const double waves = 1e9 / nanometres; // per metre
        std::array<double, 4> weights{};
        for (std::size_t i = 0; i < 4; ++i)
            weights[i] = lobes[i].height *
                         std::exp(-std::pow(waves - lobes[i].centre, 2.0) / (4.0 * lobes[i].halfVariance)) *
                         waves / nanometres;
        for (int channel = 0; channel < 3; ++channel) {
            const double weight = toRgb[channel][0] * (weights[0] + weights[1]) +
                                  toRgb[channel][1] * weights[2] + toRgb[channel][2] * weights[3];
            const double root = std::sqrt(bare[channel]);
            const double below = root < 1.0 ? (1.0 + root) / (1.0 - root) : 1e9;
            const double lower = schlick(inside, std::pow((below - index) / (below + index), 2.0));
            const double turned = below > index ? pi : 0.0;
            const std::complex<double> second =
                std::polar(std::sqrt(lower), 4.0 * pi * index * thickness * inside / nanometres + turned);
            const double first = -std::sqrt(upper);
            sum[channel] += weight * std::norm((first + second) / (1.0 + first * second));
            white[channel] += weight;
        }
    }
    return glm::clamp(sum / white, 0.0, 1.0);
}

TEST(Film, HasTheColoursOfAirysFormula) {
    for (const double index : {1.1, 1.33, 1.8, 2.4})
        for (const double thickness : {30.0, 120.0, 250.0, 400.0, 800.0, 3000.0})
            for (const Direction &bare :
                 {Direction(0.04), Direction(0.95, 0.64, 0.54), Direction(1.0, 0.3, 0.0)})
                for (const double cosine : {1.0, 0.8, 0.5, 0.2}) {
                    const Iridescence<double> film = filmOf(index, thickness, bare);
                    const Direction found = iridescentReflectance(film, cosine);
                    const Direction expected = byAiry(index, thickness, bare, cosine);
                    for (int channel = 0; channel < 3; ++channel)
                        EXPECT_NEAR(found[channel], expected[channel], cosine < 0.5 ? 0.02 : 0.004)
                            << index << ", " << thickness << " nm, " << bare[channel] << ", " << cosine;
                }
}

TEST(Film, ThatVanishesReflectsWhatLiesBelow) {
    for (const double index : {1.1, 1.5, 2.0})
        for (const double bare : {0.0, 0.04, 0.5, 1.0})
            EXPECT_NEAR(iridescentReflectance(filmOf(index, 1e-3, Direction(bare)), 1.0).x, bare, 2e-3)
                << index << ", " << bare;
}

TEST(Film, ThatIsThickHasNoColour) {
    const Direction reflected = iridescentReflectance(filmOf(1.5, washedOut, Direction(0.3)), 0.7);
    EXPECT_NEAR(reflected.x, reflected.y, 1e-9);
    EXPECT_NEAR(reflected.x, reflected.z, 1e-9);
}

TEST(Film, OfNoThicknessOrNoShareIsNone) {
    const Direction view = viewAt(0.6);
    const Direction light(-0.3, 0.2, std::sqrt(0.87));
    for (const bool isGlass : {false, true})
        for (const float metallic : {0.0f, 0.5f}) {
            layout::MaterialRecord bare =
                isGlass ? filmOnThinGlass(0.09, 300.0f) : filmOn(0.09, metallic, 300.0f);
            bare.iridescence = 0.0f;
            layout::MaterialRecord flat = bare;
            flat.iridescence = 1.0f;
            for (const float thickness : {0.0f, -5.0f, std::numeric_limits<float>::quiet_NaN()}) {
                flat.iridescenceThickness = thickness;
                const BsdfEval<double> one = evalBsdf(scene, seenFrom(bare, view), light);
                const BsdfEval<double> other = evalBsdf(scene, seenFrom(flat, view), light);
                EXPECT_EQ(one.value, other.value) << thickness;
                EXPECT_EQ(one.pdf, other.pdf) << thickness;
            }
        }
}

TEST(Film, OfALittleShareChangesLittle) {
    const Direction view = viewAt(0.6);
    const Direction light(-0.3, 0.2, std::sqrt(0.87));
    for (const float metallic : {0.0f, 1.0f}) {
        layout::MaterialRecord bare = filmOn(0.09, metallic, 300.0f);
        bare.iridescence = 0.0f;
        layout::MaterialRecord little = bare;
        little.iridescence = 1e-5f;
        EXPECT_NEAR(evalBsdf(scene, seenFrom(bare, view), light).value.x,
                    evalBsdf(scene, seenFrom(little, view), light).value.x, 1e-5);
    }
}

TEST(Film, ReflectsAlikeFromBothSides) {
    const layout::MaterialRecord material = filmOnGlassOf(0.01, 420.0f, 1.7f);
    for (const double cosine : {1.0, 0.6, 0.1}) {
        const Iridescence<double> outside = filmOnGlass<double>(material, 1.0 / 1.5, false);
        const Iridescence<double> inside = filmOnGlass<double>(material, 1.5, true);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(iridescentReflectance(outside, cosine)[channel],
                        iridescentReflectance(inside, cosine)[channel], 1e-6);
    }
}

TEST(Film, OnGlassReflectsByTheAngleOutside) {
    const layout::MaterialRecord material = filmOnGlassOf(0.01, 420.0f, 1.7f);
    const Direction facet(0, 0, 1);
    for (const double outside : {1.0, 0.7, 0.2}) {
        const double inside = std::sqrt(1.0 - (1.0 - outside * outside) / (1.5 * 1.5)); // Snell's law
        const auto reflected = [&](double cosine, double eta, bool isInside) {
            const Bsdf<double> bsdf = seenFrom(material, viewAt(cosine), 0.5, eta, isInside);
            return glassReflectance(scene, bsdf, fresnelDielectric(-bsdf.wo, facet, eta), facet);
        };
        const Direction fromOutside = reflected(outside, 1.0 / 1.5, false);
        const Direction fromInside = reflected(inside, 1.5, true);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(fromOutside[channel], fromInside[channel], 1e-6) << outside;
    }
    const Bsdf<double> trapped = seenFrom(material, viewAt(0.5), 0.5, 1.5, true);
    EXPECT_EQ(glassReflectance(scene, trapped, fresnelDielectric(-trapped.wo, facet, 1.5), facet),
              Direction(1.0));
}

TEST(Film, NeverReflectsMoreThanThereIsNorLessThanNothing) {
    for (const double index : {1.0, 1.0 + 1e-7, 1.3, 3.0, 10.0})
        for (const double thickness : {1e-6, 1.0, 90.0, 333.0, 1200.0, 1e5})
            for (const double bare : {0.0, 1e-30, 0.02, 0.5, 1.0, 7.0})
                for (const double cosine : {0.0, 1e-7, 0.1, 0.5, 1.0, 1.0 + 1e-7}) {
                    const Direction reflected =
                        iridescentReflectance(filmOf(index, thickness, Direction(bare)), cosine);
                    EXPECT_TRUE(reflected.y >= 0.0 && reflected.y <= 1.0)
                        << index << ", " << thickness << ", " << bare << ", " << cosine << ": "
                        << reflected.y;
                }
}

/// What facets that lose iridescentLoss() reflect once of even light, by a fine quadrature over half vectors.
double lostOnce(const Iridescence<double> &film, double cosine, double alpha) {
    constexpr int steps = 500;
    const Direction view = viewAt(cosine);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double share = (i + 0.5) / steps; // of the facets that lean less
            const double slope = alpha * std::sqrt(share / (1.0 - share));
            const double angle = pi * (j + 0.5) / steps;
            const Direction facet =
                unitVector(Direction(slope * std::cos(angle), slope * std::sin(angle), 1.0));
            const double toFacet = dotProduct(view, facet);
            const Direction light = 2.0 * toFacet * facet - view;
            if (toFacet <= 0.0 || light.z <= 0.0)
                continue;
            const auto hidden = [&](const Direction &w) {
                return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 - w.z * w.z) / (w.z * w.z)) - 1.0);
            };
            sum += iridescentLoss(film, toFacet) * toFacet / (view.z * facet.z) /
                   (1.0 + hidden(view) + hidden(light));
        }
    return sum / (steps * steps);
}

TEST(Film, KeepsFromTheBaseWhatItsFacetsReflect) {
    for (const float index : {1.3f, 2.0f})
        for (const float thickness : {150.0f, 400.0f, 900.0f})
            for (const double roughness : {0.1, 0.4, 0.7, 1.0})
                for (const double cosine : {0.1, 0.5, 1.0}) {
                    const Iridescence<double> film = filmOnOpaque<double>(
                        filmOn(roughness * roughness, 0.0f, thickness, index), 0.0, Direction(0.04));
                    const double found =
                        iridescentEnergy(film, energyOf(scene, cosine, roughness), cosine, roughness, 0.04);
                    EXPECT_NEAR(found, lostOnce(film, cosine, roughness * roughness), 0.012)
                        << index << ", " << thickness << ", " << roughness << ", " << cosine;
                }
}

// Where the film has no colour, nothing is lost, and elsewhere no more than the difference of channels.
TEST(FilmFurnace, KeepsWhatHasNoColour) {
    for (const double alpha : {0.0016, 0.3})
        for (const double cosine : {0.15, 0.7}) {
            const Albedo plastic = albedoOf(filmOn(alpha, 0.0f, washedOut, 1.8f), viewAt(cosine), 901);
            EXPECT_NEAR(plastic.mean, 1.0, 0.01 + 5.0 * plastic.error) << alpha << ", " << cosine;
            const Albedo window = albedoOf(filmOnThinGlass(alpha, washedOut), viewAt(cosine), 902, 1.0);
            EXPECT_NEAR(window.mean, 1.0, 0.015 + 5.0 * window.error) << alpha << ", " << cosine;
            for (const bool isInside : {false, true}) {
                const Albedo glass = albedoOf(filmOnGlassOf(alpha, washedOut), viewAt(cosine), 903,
                                              isInside ? 1.5 : 1.0 / 1.5, isInside);
                EXPECT_NEAR(glass.mean, 1.0, 0.03 + 5.0 * glass.error)
                    << alpha << ", " << cosine << ", " << isInside;
            }
        }
}

TEST(FilmFurnace, NothingReflectsMoreThanThereIs) {
    for (const float thickness : {120.0f, 330.0f})
        for (const double alpha : {0.0016, 0.5})
            for (const double cosine : {0.15, 0.9}) {
                const auto expectDim = [&](const layout::MaterialRecord &material, double eta,
                                           const char *what) {
                    const Albedo albedo = albedoOf(material, viewAt(cosine), 904, eta);
                    EXPECT_LT(albedo.mean, 1.012 + 5.0 * albedo.error)
                        << what << ", " << thickness << ", " << alpha << ", " << cosine;
                    EXPECT_GT(albedo.mean, 0.6)
                        << what << ", " << thickness << ", " << alpha << ", " << cosine;
                };
                expectDim(filmOn(alpha, 1.0f, thickness, 1.8f), 1.0 / 1.5, "metal");
                expectDim(filmOn(alpha, 0.5f, thickness, 1.8f), 1.0 / 1.5, "mixture");
                expectDim(filmOn(alpha, 0.0f, thickness, 1.8f), 1.0 / 1.5, "plastic");
                expectDim(filmOnThinGlass(alpha, thickness), 1.0, "window");
                expectDim(filmOnGlassOf(alpha, thickness, 1.4f), 1.0 / 1.5, "glass");
            }
}

TEST(FilmDensity, IsThatOfTheDirectionsDrawn) {
    for (const double cosine : {0.3, 0.9}) {
        const Direction view = viewAt(cosine);
        EXPECT_LT(chiSquareOf(seenFrom(filmOn(0.25, 0.0f, 300.0f, 1.8f), view), 911), 4.5) << cosine;
        EXPECT_LT(chiSquareOf(seenFrom(filmOn(0.25, 1.0f, 300.0f, 1.8f), view), 912), 4.5) << cosine;
        EXPECT_LT(chiSquareOf(seenFrom(filmOnThinGlass(0.25, 300.0f), view, 0.5, 1.0), 913), 4.5) << cosine;
        EXPECT_LT(chiSquareOf(seenFrom(filmOnGlassOf(0.25, 300.0f), view, 0.5), 914), 4.5) << cosine;
        EXPECT_LT(chiSquareOf(seenFrom(filmOnGlassOf(0.25, 300.0f), view, 0.5, 1.5, true), 915), 4.5)
            << cosine;
    }
}

TEST(Film, LiesBelowTheCoat) {
    layout::MaterialRecord coated = filmOn(0.25, 0.0f, 300.0f, 1.8f);
    coated.clearcoat = 1.0f;
    coated.clearcoatAlpha = 0.01f;
    const Bsdf<double> coat = seenFrom(coated, viewAt(0.9), 0.0);
    EXPECT_EQ(coat.iridescence.share, 0.0);
    EXPECT_EQ(coat.reflectance, Direction(0.04));
    EXPECT_EQ(seenFrom(coated, viewAt(0.9), 0.999).iridescence.share, 1.0);
}

} // namespace
} // namespace hyalite::core::reference
