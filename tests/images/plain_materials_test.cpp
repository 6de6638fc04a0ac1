// Materials: the renderers' mean radiance is that of the plain path tracer.
#include "tests/images/plain_comparison.h"
#include "tests/images/plain_scenes.h"

#include <gtest/gtest.h>

#include <string>

namespace hyalite::core {
namespace {

using testing::Comparison;
using testing::expectPlainRadiance;

/// Of what a film reflects: renderers take fewer facets of plastic than the quadrature, and no more than six
/// reflections within the film.
constexpr double filmAllowance = 6e-3;

/// A material to look at.
struct Look {
    std::string name;
    Material material;
    int maxDepth = 2;
    double allowance = testing::energyAllowance;
    int pathCount = 120'000; ///< for each region
};

void PrintTo(const Look &look, std::ostream *stream) { *stream << look.name; }

Look look(const std::string &name, MaterialKind kind, float roughness = 0.0f) {
    Look made{name, {}};
    made.material.kind = kind;
    made.material.roughness = roughness;
    return made;
}

Look metal(const std::string &name, std::size_t index, float roughness) {
    Look made = look(name, MaterialKind::Conductor, roughness);
    made.material.conductorIndex = metalNames[index].second.index;
    made.material.conductorExtinction = metalNames[index].second.extinction;
    return made;
}

Look glassLook(const std::string &name, float index, float roughness) {
    Look made = look(name, MaterialKind::Dielectric, roughness);
    made.material.refractiveIndex = index;
    made.material.absorption = {0.05f, 0.15f, 0.3f};
    made.maxDepth = 4;
    return made;
}

Look principled(const std::string &name, float roughness) {
    Look made = look(name, MaterialKind::Principled, roughness);
    made.material.albedo = {0.7f, 0.4f, 0.2f};
    return made;
}

Look gltf(const std::string &name, float roughness) {
    Look made = look(name, MaterialKind::Gltf, roughness);
    made.material.albedo = {0.7f, 0.4f, 0.2f};
    return made;
}

void addGltfLooks(std::vector<Look> &all) {
    all.push_back(gltf("GltfPlastic", 0.4f));
    all.push_back(gltf("GltfHalfMetal", 0.6f));
    all.back().material.metallic = 0.5f;
    all.push_back(gltf("GltfColouredSpecular", 0.5f));
    all.back().material.dielectricColour = {9.0f, 3.0f, 1.0f};
    all.back().material.dielectricWeight = 0.7f;
    all.push_back(gltf("GltfCoat", 0.6f));
    all.back().material.clearcoat = 0.8f;
    all.back().material.clearcoatRoughness = 0.3f;
    all.push_back(gltf("GltfCloth", 0.7f));
    all.back().material.sheenColour = {0.9f, 0.6f, 0.3f};
    all.back().material.sheenRoughness = 0.5f;
    all.push_back(gltf("GltfWindow", 0.3f));
    all.back().material.transmission = 0.8f;
    all.back().material.isThin = true;
    all.back().maxDepth = 3;
    all.push_back(gltf("GltfPearl", 0.35f));
    all.back().material.iridescence = 1.0f;
    all.back().material.iridescenceIndex = 1.7f;
    all.back().material.iridescenceThickness = 320.0f;
    all.back().allowance = filmAllowance;
    all.push_back(gltf("GltfTemperedSteel", 0.5f));
    all.back().material.metallic = 1.0f;
    all.back().material.iridescence = 0.8f;
    all.back().material.iridescenceIndex = 2.0f;
    all.back().material.iridescenceThickness = 180.0f;
    all.back().allowance = filmAllowance;
    all.push_back(gltf("GltfSoap", 0.3f));
    all.back().material.transmission = 0.9f;
    all.back().material.isThin = true;
    all.back().material.iridescence = 1.0f;
    all.back().material.iridescenceThickness = 500.0f;
    all.back().maxDepth = 3;
    all.back().allowance = filmAllowance;
    all.push_back(gltf("GltfCoatedGlass", 0.3f));
    all.back().material.transmission = 0.9f;
    all.back().material.iridescence = 1.0f;
    all.back().material.iridescenceIndex = 1.8f;
    all.back().material.iridescenceThickness = 400.0f;
    all.back().maxDepth = 4;
    all.back().allowance = filmAllowance;
    all.push_back(gltf("GltfLeaf", 0.5f));
    all.back().material.diffuseTransmission = 0.6f;
    all.back().material.diffuseTransmissionColour = {0.5f, 0.9f, 0.3f};
    all.back().material.isThin = true;
    all.back().maxDepth = 3;
    all.push_back(gltf("GltfPorcelain", 0.2f));
    all.back().material.diffuseTransmission = 0.7f;
    all.back().material.diffuseTransmissionColour = {1.0f, 0.8f, 0.6f};
    all.back().material.absorption = {0.1f, 0.2f, 0.4f};
    all.back().material.metallic = 0.1f;
    all.back().maxDepth = 4;
    all.push_back(gltf("GltfGreasedPaper", 0.4f));
    all.back().material.transmission = 0.4f;
    all.back().material.diffuseTransmission = 0.5f;
    all.back().material.isThin = true;
    all.back().maxDepth = 3;
    all.push_back(gltf("GltfGlass", 0.3f));
    all.back().material.transmission = 0.7f;
    all.back().material.absorption = {0.1f, 0.2f, 0.4f};
    all.back().maxDepth = 4;
}

std::vector<Look> looks() {
    std::vector<Look> all;
    all.push_back(look("Diffuse", MaterialKind::Diffuse));
    all.back().material.albedo = {0.8f, 0.5f, 0.2f};
    all.push_back(look("Mirror", MaterialKind::Mirror));
    all.push_back(metal("SmoothCopper", 1, 0.0f));
    all.push_back(metal("PolishedGold", 2, 0.15f));
    all.push_back(metal("RoughCopper", 1, 0.5f));
    all.push_back(metal("MattAluminium", 0, 1.0f));
    all.push_back(glassLook("ClearGlass", 1.5f, 0.0f));
    all.push_back(glassLook("FrostedGlass", 1.5f, 0.3f));
    all.push_back(glassLook("RoughDenseGlass", 2.2f, 0.7f));
    all.back().pathCount = 160'000;
    all.push_back(glassLook("DispersingGlass", 1.6f, 0.0f));
    all.back().material.dispersion = 1.0f;
    all.push_back(glassLook("FrostedDispersingGlass", 1.6f, 0.25f));
    all.back().material.dispersion = 1.0f;
    all.push_back(principled("GlossyPlastic", 0.2f));
    all.push_back(principled("RoughPlastic", 0.7f));
    all.back().material.specular = 1.0f;
    all.push_back(principled("PlasticOfHighIndex", 0.4f));
    all.back().material.refractiveIndex = 2.5f;
    all.push_back(principled("PrincipledMetal", 0.4f));
    all.back().material.metallic = 1.0f;
    all.push_back(principled("HalfMetal", 0.6f));
    all.back().material.metallic = 0.5f;
    all.push_back(principled("Lacquer", 0.6f));
    all.back().material.clearcoat = 1.0f;
    all.push_back(principled("ThinLacquerOnMetal", 0.5f));
    all.back().material.metallic = 1.0f;
    all.back().material.clearcoat = 0.5f;
    all.back().material.clearcoatRoughness = 0.3f;
    all.push_back(principled("TintedGlass", 0.2f));
    all.back().material.transmission = 1.0f;
    all.back().maxDepth = 4;
    all.push_back(principled("Everything", 0.4f));
    all.back().material.transmission = 0.5f;
    all.back().material.metallic = 0.3f;
    all.back().material.absorption = {0.5f, 0.2f, 0.1f};
    all.back().maxDepth = 4;
    all.push_back(principled("MetalBesideGlass", 0.3f));
    all.back().material.albedo = {0.9f, 0.3f, 0.05f};
    all.back().material.transmission = 0.8f;
    all.back().material.metallic = 0.5f;
    all.back().maxDepth = 4;
    addGltfLooks(all);
    return all;
}

class PlainMaterials : public ::testing::TestWithParam<Look> {};

INSTANTIATE_TEST_SUITE_P(All, PlainMaterials, ::testing::ValuesIn(looks()),
                         [](const auto &instance) { return instance.param.name; });

// Seen at all angles, lit from all around and by a point.
TEST_P(PlainMaterials, LookTheSameOnABallInAStudio) {
    TestScene scene = testing::emptyScene(GetParam().maxDepth);
    scene.environment = testing::studioEnvironment();
    const float roughness = GetParam().material.roughness;
    if (roughness == 0.0f || roughness >= 0.3f) // between, its highlight is a few bright pixels
        scene.lights.push_back({{2.0, 3.0, 4.0}, {60.0, 50.0, 40.0}});
    testing::addBall(scene, {0.0, 0.0, 0.0}, 1.0, GetParam().material);
    Comparison comparison{.regions = {{4, 12, 4, 12}, {0, 16, 0, 8}, {0, 5, 3, 13}}};
    comparison.allowance = GetParam().allowance;
    comparison.pathCount = GetParam().pathCount;
    expectPlainRadiance(scene, comparison);
}

// A tile that is seen obliquely and shows a large lamp behind it.
TEST_P(PlainMaterials, LookTheSameOnATileUnderALamp) {
    TestScene scene = testing::emptyScene(GetParam().maxDepth);
    scene.background = {0.4f, 0.6f, 0.8f};
    testing::addQuad(scene, {-2.0f, -0.8f, 2.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.4f, -4.0f},
                     GetParam().material);
    testing::addQuad(scene, {-2.0f, 2.5f, -3.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, -0.5f, 4.0f},
                     testing::lamp({3.0f, 2.5f, 2.0f}));
    Comparison comparison{.regions = {{0, 16, 7, 16}, {4, 12, 8, 11}}};
    comparison.allowance = GetParam().allowance;
    comparison.pathCount = GetParam().pathCount;
    expectPlainRadiance(scene, comparison);
}

// In a white world there is little noise: what is left of the light shows small faults of lobes and tables.
TEST(PlainFurnaces, AreAsBright) {
    for (const float roughness : {0.5f, 1.0f})
        for (const float metallic : {0.0f, 1.0f}) {
            TestScene scene = testing::emptyScene(2, 512);
            scene.background = glm::vec3(1.0f);
            Look white = principled("White", roughness);
            white.material.albedo = glm::vec3(1.0f);
            white.material.metallic = metallic;
            testing::addBall(scene, {0.0, 0.0, 0.0}, 1.0, white.material);
            expectPlainRadiance(scene, {.regions = {{4, 12, 4, 12}, {2, 6, 6, 10}},
                                        .pathCount = 160'000,
                                        .errorLimit = 6.5e-3,
                                        .allowance = testing::energyAllowance});
        }
}

} // namespace
} // namespace hyalite::core
