// Materials of glTF: sheen, thin glass, anisotropy, coats and diffuse transmission keep energy, and draw directions with
// the density that they say they have. What they look like is judged by the plain path tracer
// (tests/images/plain_materials_test.cpp).
#include "tests/fixtures/bsdf_fixture.h"

#include <gtest/gtest.h>

namespace hyalite::core::reference {
namespace {

layout::MaterialRecord gltf(double alpha, float colour) {
    layout::MaterialRecord material{};
    material.kindAndSides = layout::materialGltf;
    material.alpha = static_cast<float>(alpha);
    material.albedo = glm::vec3(colour);
    material.normalReflectance = 0.04f;
    material.clearcoatAlpha = 0.01f;
    material.sheenAlpha = 0.25f;
    material.dielectricColour = glm::vec3(1.0f);
    material.dielectricWeight = 1.0f;
    material.anisotropyCosine = 1.0f;
    return material;
}

layout::MaterialRecord thinGlass(double alpha) {
    layout::MaterialRecord material = gltf(alpha, 1.0f);
    material.kindAndSides |= layout::materialIsThin;
    material.transmission = 1.0f;
    return material;
}

/// With facets that are stretched along x.
Bsdf<double> stretched(double alpha, float anisotropy, const Direction &view) {
    layout::MaterialRecord material = gltf(alpha, 1.0f);
    material.metallic = 1.0f;
    material.anisotropy = anisotropy;
    const Direction normal(0, 0, 1);
    const SurfaceAxes<double> axes{Direction(1, 0, 0), normal};
    return makeBsdf<double>(scene, material, -view, normal, normal, axes, false, 1.0, 0.5);
}

/// What facets reflect once of even light, by quadrature of glTF's formula: GGX and the height-correlated Smith term of
/// appendix B.3.5 of its specification, stretched as in KHR_materials_anisotropy. `fresnel` takes the cosine to the
/// facet.
template <class Fresnel>
double reflectedOnce(const Direction &view, const Vec2<double> &alphas, const Fresnel &fresnel) {
    const auto hidden = [&](const Direction &w) {
        const double slope = alphas.x * alphas.x * w.x * w.x + alphas.y * alphas.y * w.y * w.y;
        return 0.5 * (std::sqrt(1.0 + slope / (w.z * w.z)) - 1.0);
    };
    constexpr int steps = 1000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double share = (i + 0.5) / steps; // of the facets that lean less
            const double slope = std::sqrt(share / (1.0 - share));
            const double angle = 2.0 * pi * (j + 0.5) / steps;
            const Direction facet = unitVector(
                Direction(alphas.x * slope * std::cos(angle), alphas.y * slope * std::sin(angle), 1.0));
            const double cosine = dotProduct(view, facet);
            const Direction light = 2.0 * cosine * facet - view;
            if (cosine > 0.0 && light.z > 0.0)
                sum += fresnel(cosine) * cosine / (view.z * facet.z) / (1.0 + hidden(view) + hidden(light));
        }
    return sum / (steps * steps);
}

double schlick(double cosine) { return 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0); }

TEST(Sheen, ItsTableIsWhatTheLobeReflects) {
    for (const double roughness : {0.2, 0.5, 1.0})
        for (const double cosine : {0.1, 0.4, 0.9}) {
            const double alpha = roughness * roughness;
            double sum = 0.0;
            constexpr int steps = 400;
            const Direction view = viewAt(cosine);
            for (int i = 0; i < steps; ++i)
                for (int j = 0; j < steps; ++j) {
                    const double z = (i + 0.5) / steps;
                    const double angle = pi * (j + 0.5) / steps;
                    const double sine = std::sqrt(1.0 - z * z);
                    const Direction facet =
                        unitVector(view + Direction(sine * std::cos(angle), sine * std::sin(angle), z));
                    sum += sheenValue(cosine, z, facet.z, alpha);
                }
            EXPECT_NEAR(sheenAlbedo(scene, cosine, alpha), sum * 2.0 * pi / (steps * steps), 2e-3)
                << roughness << ", " << cosine;
        }
}

TEST(Sheen, TakesFromWhatLiesBelow) {
    layout::MaterialRecord material = gltf(0.25, 1.0f);
    material.sheenColour = glm::vec3(1.0f);
    for (const double cosine : {0.2, 0.6, 1.0}) {
        const Albedo albedo = albedoOf(material, viewAt(cosine), 811);
        EXPECT_NEAR(albedo.mean, 1.0, 0.004 + 5.0 * albedo.error) << cosine;
    }
}

TEST(ThinGlass, ReflectsAndPassesEverything) {
    for (const double alpha : {0.0016, 0.09, 0.5})
        for (const double cosine : {0.15, 0.5, 1.0}) {
            const Albedo albedo = albedoOf(thinGlass(alpha), viewAt(cosine), 812, 1.0);
            EXPECT_NEAR(albedo.mean, 1.0, 0.01 + 5.0 * albedo.error) << alpha << ", " << cosine;
        }
}

TEST(ThinGlass, LetsSmoothLightPassStraight) {
    const Direction view = viewAt(0.6);
    const Bsdf<double> bsdf = seenFrom(thinGlass(0.0016), view, 0.5, 1.0);
    const double middle = bsdf.specularProbability + 0.5 * bsdf.thinProbability;
    const Direction light = sampleBsdf(scene, bsdf, Vec2<double>(0.25, 0.0), middle);
    EXPECT_NEAR(light.x, -view.x, 0.01);
    EXPECT_NEAR(light.z, -view.z, 0.01);
}

TEST(GltfCoat, DimsTheBaseByItsFresnelTerm) {
    layout::MaterialRecord material = gltf(0.25, 1.0f);
    material.clearcoat = 0.75f;
    for (const double cosine : {0.2, 0.7, 1.0}) {
        // Below the coat the light is 1; the coat itself reflects clearcoatAlbedo.
        const double fresnel = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
        const double expected = 0.75 * clearcoatAlbedo(scene, cosine, 0.1) + 1.0 - 0.75 * fresnel;
        const Albedo albedo = albedoOf(material, viewAt(cosine), 813);
        EXPECT_NEAR(albedo.mean, expected, 0.004 + 5.0 * albedo.error) << cosine;
    }
}

TEST(GltfCoat, OfRoughnessOneReflectsWhatTheFormulaDoes) {
    layout::MaterialRecord material = gltf(0.25, 1.0f);
    material.clearcoat = 1.0f;
    material.clearcoatAlpha = 1.0f;
    for (const double cosine : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        const Direction view = viewAt(cosine);
        const double expected = reflectedOnce(view, {1.0, 1.0}, schlick) + 1.0 - schlick(cosine);
        const Albedo albedo = albedoOf(material, view, 814);
        EXPECT_NEAR(albedo.mean, expected, 0.002 + 4.0 * albedo.error) << cosine;
    }
}

TEST(Anisotropy, ReflectsWhatTheFormulaDoesAndWhatFacetsLoseAtOnce) {
    for (const double alpha : {0.04, 0.25})
        for (const float anisotropy : {0.5f, 1.0f})
            for (const Direction &view : {viewAt(1.0), viewAt(0.3), Direction(0.0, 0.8, 0.6)}) {
                const Bsdf<double> bsdf = stretched(alpha, anisotropy, view);
                const double lost = 1.0 - energyOf(scene, view.z, bsdf.roughness).white;
                const double once = reflectedOnce(view, bsdf.alphas, [](double) { return 1.0; });
                const Albedo albedo = albedoOf(bsdf, 815);
                EXPECT_NEAR(albedo.mean, once + lost, 0.002 + 4.0 * albedo.error)
                    << alpha << ", " << anisotropy << ", " << view.z;
            }
}

TEST(Anisotropy, OfStrengthZeroIsNone) {
    const Direction view = viewAt(0.6);
    const Bsdf<double> none = stretched(0.25, 0.0f, view);
    const Bsdf<double> little = stretched(0.25, 1e-6f, view);
    for (const Direction &light : {viewAt(0.3), Direction(0.0, 0.6, 0.8), Direction(-0.6, 0.0, 0.8)}) {
        EXPECT_NEAR(evalBsdf(scene, none, light).value.x, evalBsdf(scene, little, light).value.x, 1e-9);
        EXPECT_NEAR(evalBsdf(scene, none, light).pdf, evalBsdf(scene, little, light).pdf, 1e-9);
    }
}

TEST(Anisotropy, SpreadsLightAlongTheTangent) {
    const Bsdf<double> bsdf = stretched(0.04, 0.8f, {0, 0, 1});
    EXPECT_NEAR(bsdf.alphas.x, 0.04 + 0.96 * 0.64, 1e-6);
    EXPECT_NEAR(bsdf.alphas.y, 0.04, 1e-8);
    EXPECT_GT(evalBsdf(scene, bsdf, {0.6, 0.0, 0.8}).value.x,
              10.0 * evalBsdf(scene, bsdf, {0.0, 0.6, 0.8}).value.x);
}

TEST(Anisotropy, ItsDistributionCoversTheSurface) {
    const Vec2<double> alphas(0.6, 0.1);
    double sum = 0.0;
    constexpr int steps = 2000;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 200; ++j) {
            const double z = (i + 0.5) / steps;
            const double angle = 2.0 * pi * (j + 0.5) / 200;
            const double sine = std::sqrt(1.0 - z * z);
            sum += ggxD(Direction(sine * std::cos(angle), sine * std::sin(angle), z), alphas) * z;
        }
    EXPECT_NEAR(sum * 2.0 * pi / (steps * 200.0), 1.0, 1e-3);
}

layout::MaterialRecord leaf(double alpha, float transmission, float colour = 1.0f) {
    layout::MaterialRecord material = gltf(alpha, 1.0f);
    material.kindAndSides |= layout::materialIsThin;
    material.diffuseTransmission = transmission;
    material.diffuseTransmissionColour = glm::vec3(colour);
    return material;
}

TEST(DiffuseTransmission, LosesNoLight) {
    for (const float transmission : {0.25f, 1.0f})
        for (const double alpha : {0.0016, 0.25, 1.0})
            for (const double cosine : {0.15, 0.5, 1.0}) {
                const Albedo albedo = albedoOf(leaf(alpha, transmission), viewAt(cosine), 841, 1.0);
                EXPECT_NEAR(albedo.mean, 1.0, 0.004 + 5.0 * albedo.error)
                    << transmission << ", " << alpha << ", " << cosine;
            }
}

// The base's light is divided between both sides, in equal directions.
TEST(DiffuseTransmission, MirrorsTheBaseAtTheSurface) {
    const Direction view = viewAt(0.7);
    const Bsdf<double> half = seenFrom(leaf(0.25, 0.25f, 0.5f), view);
    const Bsdf<double> opaque = seenFrom(leaf(0.25, 0.0f), view);
    const Bsdf<double> facets = seenFrom(leaf(0.25, 1.0f), view); // no base on this side
    for (const Direction &light : {viewAt(0.9), Direction(0.0, 0.8, 0.6), Direction(-0.8, 0.0, 0.6)}) {
        const Direction beyond(light.x, light.y, -light.z);
        const double once = evalBsdf(scene, facets, light).value.x;
        const double base = evalBsdf(scene, opaque, light).value.x - once;
        EXPECT_GT(base, 0.1);
        EXPECT_NEAR(evalBsdf(scene, half, light).value.x - once, 0.75 * base, 1e-7);
        EXPECT_NEAR(evalBsdf(scene, half, beyond).value.x, 0.25 * 0.5 * base, 1e-7);
        EXPECT_EQ(evalBsdf(scene, opaque, beyond).value.x, 0.0);
    }
}

TEST(DiffuseTransmission, IsReciprocal) {
    const layout::MaterialRecord material = leaf(0.16, 0.5f);
    const Direction above = viewAt(0.8);
    const Direction below(0.0, std::sqrt(1.0 - 0.09), -0.3);
    const Direction fromBelow(below.x, below.y, -below.z);
    // Seen from below, the surface is turned over.
    const double there = evalBsdf(scene, seenFrom(material, above), below).value.x / 0.3;
    const double back =
        evalBsdf(scene, seenFrom(material, fromBelow), {above.x, above.y, -above.z}).value.x / 0.8;
    EXPECT_NEAR(there, back, 1e-7);
}

TEST(DiffuseTransmission, IsTheDiffuseShareOfWhatPasses) {
    layout::MaterialRecord paper = leaf(0.16, 0.25f);
    paper.transmission = 0.5f;
    const Bsdf<double> bsdf = seenFrom(paper, viewAt(0.8));
    for (const Direction &light : {Direction(-0.6, 0.0, -0.8), Direction(0.6, 0.0, -0.8)}) {
        const Direction value = evalBsdf(scene, bsdf, light).value;
        const double passedByFacets = evalThin(scene, bsdf, light).value.x;
        EXPECT_NEAR(diffuseShare(scene, bsdf, light, value).x, 1.0 - passedByFacets / value.x, 1e-6);
    }
}

TEST(GltfDensity, IsThatOfTheDirectionsDrawn) {
    layout::MaterialRecord cloth = gltf(0.25, 0.5f);
    cloth.sheenColour = glm::vec3(1.0f);
    for (const double cosine : {0.3, 0.9}) {
        const Direction view = viewAt(cosine);
        EXPECT_LT(chiSquareOf(seenFrom(gltf(0.25, 0.5f), view), 821), 4.5) << cosine;
        EXPECT_LT(chiSquareOf(seenFrom(cloth, view, 0.01), 822), 4.5) << cosine;
        EXPECT_LT(chiSquareOf(seenFrom(thinGlass(0.25), view, 0.5, 1.0), 823), 4.5) << cosine;
        EXPECT_LT(chiSquareOf(stretched(0.16, 0.7f, view), 824), 4.5) << cosine;
        EXPECT_LT(chiSquareOf(seenFrom(leaf(0.25, 0.6f), view), 825), 4.5) << cosine;
    }
}

TEST(GltfMaterial, NothingReflectsMoreThanThereIs) {
    layout::MaterialRecord material = gltf(0.36, 1.0f);
    material.clearcoat = 1.0f;
    material.sheenColour = glm::vec3(0.8f);
    material.metallic = 0.3f;
    material.dielectricColour = glm::vec3(10.0f);
    for (const double cosine : {0.15, 0.5, 1.0}) {
        const Albedo albedo = albedoOf(material, viewAt(cosine), 831);
        EXPECT_LT(albedo.mean, 1.01 + 5.0 * albedo.error) << cosine;
        EXPECT_GT(albedo.mean, 0.85) << cosine;
    }
}

} // namespace
} // namespace hyalite::core::reference
