// glTF: materials and textures.
#include "host/import/gltf/materials.h"
#include "host/scene/limits.h"
#include "tests/fixtures/gltf_fixture.h"
#include "tests/fixtures/png_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace hyalite::core {
namespace {

class GltfMaterial : public GltfFolder {
  protected:
    void SetUp() override {
        GltfFolder::SetUp();
        image = onePixelPng(128, 128, 255);
        static_cast<void>(write("image.png", image));
    }

    /// A file of that material, with a texture 0.
    [[nodiscard]] GltfMaker makerOf(const std::string &material) const {
        GltfMaker maker = oneTriangle();
        nlohmann::json &primitive = maker.json["meshes"][0]["primitives"][0];
        primitive["material"] = 0;
        primitive["attributes"]["TEXCOORD_0"] = maker.addVec2({0, 0, 1, 0, 0, 1});
        maker.json["materials"] = {nlohmann::json::parse(material)};
        maker.json["textures"] = {{{"source", 0}}};
        maker.json["images"] = {{{"uri", "image.png"}}};
        return maker;
    }
    [[nodiscard]] Material read(const std::string &material) const {
        return load(makerOf(material)).scene.materials.at(1);
    }
    [[nodiscard]] std::string refusalOfMaterial(const std::string &material) const {
        return refusal(makerOf(material));
    }

    std::string image;
};

TEST_F(GltfMaterial, HasTheDefaultsOfTheSpecification) {
    const Material material = read("{}");
    EXPECT_EQ(material.kind, MaterialKind::Gltf);
    EXPECT_EQ(material.albedo, glm::vec3(1.0f));
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 1.0f);
    EXPECT_EQ(material.refractiveIndex, 1.5f);
    EXPECT_EQ(material.emission, glm::vec3(0.0f));
    EXPECT_EQ(material.alphaMode, AlphaMode::Opaque);
    EXPECT_TRUE(material.isCulled);
    EXPECT_TRUE(material.isThin);
    EXPECT_FALSE(material.twoSided);
    EXPECT_EQ(material.name, "/materials/0");
}

TEST_F(GltfMaterial, ReadsTheCore) {
    const Material material =
        read(R"({"name": "all", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
        "emissiveFactor": [0.5, 0.25, 1], "emissiveTexture": {"index": 0},
        "normalTexture": {"index": 0, "scale": 0.5}, "occlusionTexture": {"index": 0},
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.6,
        "roughnessFactor": 0.7, "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}})");
    EXPECT_EQ(material.name, "all");
    EXPECT_EQ(material.albedo, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.opacity, 0.4f);
    EXPECT_EQ(material.metallic, 0.6f);
    EXPECT_EQ(material.roughness, 0.7f);
    EXPECT_EQ(material.emission, glm::vec3(2.0f, 1.0f, 4.0f));
    EXPECT_EQ(material.alphaMode, AlphaMode::CutOut);
    EXPECT_EQ(material.alphaCutoff, 0.25f);
    EXPECT_EQ(material.normalStrength, 0.5f);
    EXPECT_TRUE(material.twoSided);
    EXPECT_FALSE(material.isCulled);
    ASSERT_TRUE(material.textures[layout::slotRoughness] && material.textures[layout::slotMetallic]);
    EXPECT_EQ(material.textures[layout::slotRoughness]->channel, Channel::Green);
    EXPECT_EQ(material.textures[layout::slotMetallic]->channel, Channel::Blue);
    EXPECT_TRUE(material.textures[layout::slotBaseColour] && material.textures[layout::slotNormal] &&
                material.textures[layout::slotEmission]);
    EXPECT_FALSE(material.textures[layout::slotOpacity]); // the image has no alpha
}

TEST_F(GltfMaterial, IsOpaqueWhateverItsAlphaUnlessItSaysOtherwise) {
    const Material material = read(R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}})");
    EXPECT_EQ(material.opacity, 1.0f);
    EXPECT_EQ(read(R"({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}})")
                  .opacity,
              0.5f);
}

TEST_F(GltfMaterial, ReadsTheExtensionsOfSurfaces) {
    const Material material = read(R"({"extensions": {
        "KHR_materials_ior": {"ior": 1.3},
        "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 2, 3],
            "specularTexture": {"index": 0}, "specularColorTexture": {"index": 0}},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25,
            "clearcoatTexture": {"index": 0}, "clearcoatRoughnessTexture": {"index": 0},
            "clearcoatNormalTexture": {"index": 0, "scale": 2}},
        "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.4,
            "sheenColorTexture": {"index": 0}, "sheenRoughnessTexture": {"index": 0}},
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 1.5,
            "anisotropyTexture": {"index": 0}}, "KHR_materials_unlit": {}}})");
    EXPECT_EQ(material.refractiveIndex, 1.3f);
    EXPECT_EQ(material.dielectricWeight, 0.5f);
    EXPECT_EQ(material.dielectricColour, glm::vec3(1, 2, 3));
    EXPECT_EQ(material.textures[layout::slotDielectricWeight]->channel, Channel::Alpha);
    EXPECT_TRUE(material.textures[layout::slotDielectricColour]);
    EXPECT_EQ(material.clearcoat, 0.75f);
    EXPECT_EQ(material.clearcoatRoughness, 0.25f);
    EXPECT_EQ(material.clearcoatNormalStrength, 2.0f);
    EXPECT_EQ(material.textures[layout::slotClearcoat]->channel, Channel::Red);
    EXPECT_EQ(material.textures[layout::slotClearcoatRoughness]->channel, Channel::Green);
    EXPECT_TRUE(material.textures[layout::slotClearcoatNormal]);
    EXPECT_EQ(material.sheenColour, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.sheenRoughness, 0.4f);
    EXPECT_EQ(material.textures[layout::slotSheenRoughness]->channel, Channel::Alpha);
    EXPECT_EQ(material.anisotropy, 0.6f);
    EXPECT_EQ(material.anisotropyRotation, 1.5f);
    EXPECT_TRUE(material.textures[layout::slotAnisotropy]);
    EXPECT_TRUE(material.isUnlit);
}

TEST_F(GltfMaterial, ReadsIridescentFilms) {
    const Material material = read(R"({"extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 0.75,
        "iridescenceTexture": {"index": 0}, "iridescenceIor": 1.8, "iridescenceThicknessMinimum": 500,
        "iridescenceThicknessMaximum": 200, "iridescenceThicknessTexture": {"index": 0}}}})");
    EXPECT_EQ(material.iridescence, 0.75f);
    EXPECT_EQ(material.iridescenceIndex, 1.8f);
    EXPECT_EQ(material.iridescenceThicknessMinimum, 500.0f);
    EXPECT_EQ(material.iridescenceThickness, 200.0f);
    EXPECT_EQ(material.textures[layout::slotIridescence]->channel, Channel::Red);
    EXPECT_EQ(material.textures[layout::slotIridescenceThickness]->channel, Channel::Green);
    const Material usual = read(R"({"extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1}}})");
    EXPECT_EQ(usual.iridescenceIndex, 1.3f);
    EXPECT_EQ(usual.iridescenceThicknessMinimum, 100.0f);
    EXPECT_EQ(usual.iridescenceThickness, 400.0f);
    EXPECT_EQ(scatteringOfGltf(usual), layout::scattersAtGltf | layout::scattersAtIridescent);
    const Material none = read(R"({"extensions": {"KHR_materials_iridescence": {
        "iridescenceTexture": {"index": 0}, "iridescenceThicknessTexture": {"index": 0}}}})");
    EXPECT_FALSE(none.textures[layout::slotIridescence] || none.textures[layout::slotIridescenceThickness]);
    EXPECT_EQ(scatteringOfGltf(none), layout::scattersAtGltf);
    GltfMaker maker = makerOf(R"({"extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1}}})");
    maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = {"KHR_materials_iridescence"};
    EXPECT_TRUE(load(maker).meshReports.at(0).warnings.empty());
}

TEST_F(GltfMaterial, ReadsDiffuseTransmission) {
    const Material material = read(R"({"extensions": {"KHR_materials_diffuse_transmission": {
        "diffuseTransmissionFactor": 0.75, "diffuseTransmissionTexture": {"index": 0},
        "diffuseTransmissionColorFactor": [0.5, 0.25, 1], "diffuseTransmissionColorTexture": {"index": 0}},
        "KHR_materials_volume": {"thicknessFactor": 0.1, "attenuationDistance": 2,
        "attenuationColor": [0.5, 1, 1]}}})");
    EXPECT_EQ(material.diffuseTransmission, 0.75f);
    EXPECT_EQ(material.diffuseTransmissionColour, glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_EQ(material.textures[layout::slotDiffuseTransmission]->channel, Channel::Alpha);
    EXPECT_EQ(material.textures[layout::slotDiffuseTransmissionColour]->channel, Channel::Red);
    EXPECT_TRUE(holdsMedium(material));
    EXPECT_FALSE(isGlass(material));
    EXPECT_EQ(scatteringOfGltf(material), layout::scattersAtGltf | layout::scattersAtDiffuseTransmission);
    const Material leaf = read(R"({"extensions": {"KHR_materials_diffuse_transmission": {
        "diffuseTransmissionFactor": 0.5}}})");
    EXPECT_EQ(leaf.diffuseTransmissionColour, glm::vec3(1.0f));
    EXPECT_FALSE(holdsMedium(leaf) || leaf.isCulled);
    const Material none = read(R"({"extensions": {"KHR_materials_diffuse_transmission": {
        "diffuseTransmissionTexture": {"index": 0}, "diffuseTransmissionColorTexture": {"index": 0}}}})");
    EXPECT_FALSE(none.textures[layout::slotDiffuseTransmission] ||
                 none.textures[layout::slotDiffuseTransmissionColour]);
    EXPECT_EQ(scatteringOfGltf(none), layout::scattersAtGltf);
}

TEST_F(GltfMaterial, ReadsDispersionOfVolumes) {
    const std::string diamond = R"("KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_dispersion": {"dispersion": 0.36})";
    const Material material =
        read(R"({"extensions": {"KHR_materials_volume": {"thicknessFactor": 1}, )" + diamond + "}}");
    EXPECT_EQ(material.dispersion, 0.36f);
    EXPECT_EQ(scatteringOfGltf(material),
              layout::scattersAtGltf | layout::scattersAtRoughGlass | layout::scattersAtDispersion);
    EXPECT_EQ(read(R"({"extensions": {)" + diamond + "}}").dispersion, 0.0f);
}

TEST_F(GltfMaterial, OfRefractiveIndexZeroReflectsEverythingHeadOn) {
    const Material material = read(R"({"extensions": {"KHR_materials_ior": {"ior": 0}}})");
    const double n = static_cast<double>(material.refractiveIndex);
    const double reflectance = std::pow((n - 1.0) / (n + 1.0), 2.0);
    EXPECT_NEAR(reflectance * static_cast<double>(material.dielectricColour.x), 1.0, 1e-6);
    EXPECT_TRUE(refusalOfMaterial(R"({"extensions": {"KHR_materials_ior": {"ior": 0.5}}})")
                    .starts_with("/materials/0/extensions/KHR_materials_ior/ior: "));
}

TEST_F(GltfMaterial, IsThinUnlessItHasAVolumeWhichAbsorbsByBeersLaw) {
    const Material thin =
        read(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.5}}})");
    EXPECT_EQ(thin.transmission, 0.5f);
    EXPECT_TRUE(thin.isThin);
    EXPECT_FALSE(thin.isCulled);
    const Material thick = read(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0]}}})");
    EXPECT_FALSE(thick.isThin);
    EXPECT_EQ(thick.absorption.x, 0.0f);
    EXPECT_NEAR(thick.absorption.y, std::log(2.0) / 2.0, 1e-6);
    EXPECT_GT(thick.absorption.z, 5.0f);
    EXPECT_TRUE(std::isfinite(thick.absorption.z));
    EXPECT_EQ(
        read(
            R"({"extensions": {"KHR_materials_volume": {"thicknessFactor": 1, "attenuationColor": [0, 0, 0]}}})")
            .absorption,
        glm::vec3(0.0f));
}

const char *const absorbingGlass = R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
    "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0]}}})";

TEST_F(GltfMaterial, IsThinBeyondAsManyVolumesAsPathsTellApart) {
    GltfMaker maker = makerOf(absorbingGlass);
    nlohmann::json &materials = maker.json["materials"];
    while (materials.size() < limits::mediumCount + 2) {
        materials.push_back(materials[0]);
        materials.back()["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 2 + materials.size();
    }
    const LoadedScene loaded = load(maker);
    for (std::size_t i = 0; i < limits::mediumCount + 2; ++i)
        EXPECT_EQ(loaded.scene.materials.at(i + 1).isThin, i >= limits::mediumCount) << i;
    ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u);
    EXPECT_NE(loaded.meshReports[0].warnings[0].find("10 materials are glass with volumes that differ"),
              std::string::npos)
        << loaded.meshReports[0].warnings[0];
}

TEST_F(GltfMaterial, OfTooManyVolumesIsThatOfAnEqualOne) {
    GltfMaker maker = makerOf(absorbingGlass);
    nlohmann::json &materials = maker.json["materials"];
    while (materials.size() < limits::mediumCount + 2) {
        materials.push_back(materials[0]);
        materials.back()["name"] = std::to_string(materials.size());
        materials.back()["extensions"]["KHR_materials_volume"]["thicknessFactor"] = materials.size();
    }
    maker.json["meshes"][0]["primitives"][0]["material"] = materials.size() - 1;
    const LoadedScene loaded = load(maker);
    EXPECT_TRUE(loaded.meshReports.at(0).warnings.empty());
    ASSERT_EQ(loaded.scene.meshes.at(0).triangleMaterials.size(), 1u);
    const Material &shown = loaded.scene.materials.at(loaded.scene.meshes[0].triangleMaterials[0]);
    EXPECT_FALSE(shown.isThin);
    EXPECT_GT(shown.absorption.y, 0.0f);
}

TEST_F(GltfMaterial, ReadsSpecularGlossiness) {
    const Material plain = read(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor": [0.1, 0.2, 0.3, 1], "specularFactor": [0.4, 0.5, 0.6], "glossinessFactor": 0.75}}})");
    EXPECT_TRUE(plain.isSpecularGlossy);
    EXPECT_EQ(plain.albedo, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(plain.dielectricColour, glm::vec3(0.4f, 0.5f, 0.6f));
    EXPECT_EQ(plain.roughness, 0.25f);
    EXPECT_EQ(plain.metallic, 0.0f);
    const Material textured = read(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
        {"glossinessFactor": 0.75, "specularGlossinessTexture": {"index": 0}, "diffuseTexture": {"index": 0}}}})");
    EXPECT_EQ(textured.roughness, 0.75f);
    EXPECT_EQ(textured.textures[layout::slotRoughness]->channel, Channel::Alpha);
    EXPECT_TRUE(textured.textures[layout::slotDielectricColour] && textured.textures[layout::slotBaseColour]);
}

TEST_F(GltfMaterial, WhatHasNoSingleMeaningIsRefused) {
    EXPECT_TRUE(refusalOfMaterial(R"({"pbrMetallicRoughness": {"metallicFactor": "2"}})")
                    .starts_with("/materials/0/pbrMetallicRoughness/metallicFactor: "));
    EXPECT_TRUE(
        refusalOfMaterial(R"({"emissiveFactor": [1, 2]})").starts_with("/materials/0/emissiveFactor: "));
    EXPECT_TRUE(refusalOfMaterial(R"({"alphaMode": "mask"})").starts_with("/materials/0/alphaMode: "));
    EXPECT_TRUE(refusalOfMaterial(R"({"normalTexture": {"index": 3}})")
                    .starts_with("/materials/0/normalTexture/index: "));
}

TEST_F(GltfMaterial, TexturesTurnAsInGltf) {
    // What glTF's matrices give at a point, and what ours gives at the same point with v upwards.
    const gltf::UvTransform transform{{0.3, -0.2}, 0.7, {2.0, 0.5}};
    TextureUse use;
    gltf::place(use, transform);
    for (const glm::dvec2 uv : {glm::dvec2(0.0, 0.0), glm::dvec2(0.25, 0.75), glm::dvec2(1.0, 0.5)}) {
        const double c = std::cos(transform.rotation);
        const double s = std::sin(transform.rotation);
        const glm::dvec2 scaled = uv * transform.scale;
        const glm::dvec2 expected(c * scaled.x + s * scaled.y + transform.offset.x,
                                  -s * scaled.x + c * scaled.y + transform.offset.y);
        const double u = uv.x;
        const double v = 1.0 - uv.y;
        EXPECT_NEAR(use.scale.x * u + use.shear.x * v + use.offset.x, expected.x, 1e-6);
        EXPECT_NEAR(1.0 - (use.shear.y * u + use.scale.y * v + use.offset.y), expected.y, 1e-6);
    }
    TextureUse still;
    gltf::place(still, {});
    EXPECT_EQ(still.scale, glm::vec2(1.0f));
    EXPECT_EQ(still.offset, glm::vec2(0.0f));
    EXPECT_EQ(still.shear, glm::vec2(0.0f));
}

TEST_F(GltfMaterial, TexturesHaveSamplersAndSets) {
    GltfMaker maker = makerOf(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 0,
        "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "texCoord": 1}}}}})");
    maker.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    maker.json["textures"][0]["sampler"] = 0;
    maker.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        maker.addVec2({0.5, 0, 0.5, 0, 0.5, 0});
    const LoadedScene loaded = load(maker);
    const TextureUse use = loaded.scene.materials.at(1).textures[layout::slotBaseColour].value();
    EXPECT_EQ(use.wrapU, Wrap::Clamp);
    EXPECT_EQ(use.wrapV, Wrap::Mirror);
    EXPECT_TRUE(use.isNearest);
    EXPECT_EQ(use.uvSet, 1u);
    EXPECT_EQ(use.offset, glm::vec2(0.5f, 0.0f));
    EXPECT_EQ(loaded.scene.meshes.at(0).secondUvs.values.at(0), glm::vec2(0.5f, 1.0f));
}

TEST_F(GltfMaterial, ImagesComeFromFilesViewsAndDataUris) {
    const char *material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
    GltfMaker maker = makerOf(material);
    maker.json["images"] = {{{"bufferView", maker.addView(image)}, {"mimeType", "image/png"}}};
    const LoadedScene embedded = load(maker);
    ASSERT_EQ(embedded.scene.textures.size(), 1u);
    EXPECT_TRUE(embedded.scene.textures[0].name.ends_with("scene.glb#/images/0"));
    EXPECT_EQ(embedded.scene.textures[0].levels, (std::vector<std::uint32_t>{0xFFFF8080u}));
    // A WebP of 2 x 2 pixels, the last one transparent, by the extension and instead of the other source.
    const std::string webp = "data:image/webp;base64,UklGRioAAABXRUJQVlA4TB4AAAAvAUAAEB8gEEjaH3qN+RcQFPk/"
                             "2vwH8KVgFyL6HwE=";
    maker.json["images"].push_back({{"uri", webp}});
    maker.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    const LoadedScene extended = load(maker);
    EXPECT_TRUE(extended.meshReports.at(0).warnings.empty()) << extended.meshReports[0].warnings[0];
    ASSERT_EQ(extended.scene.textures.size(), 1u);
    EXPECT_EQ(extended.scene.textures[0].width, 2);
    EXPECT_TRUE(extended.scene.textures[0].hasAlpha);
    EXPECT_EQ(extended.scene.textures[0].levels[0], 0xFF0000FFu);
}

TEST_F(GltfMaterial, BadImagesAreLeftOutWithAWarning) {
    const char *material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
    for (const char *uri : {"none.png", "../outside.png", "broken.png", "data:image/png;base64,AAAA",
                            "http://example.org/a.png"}) {
        GltfMaker maker = makerOf(material);
        static_cast<void>(write("broken.png", image.substr(0, 40)));
        maker.json["images"][0]["uri"] = uri;
        const LoadedScene loaded = load(maker);
        EXPECT_FALSE(loaded.scene.materials.at(1).textures[layout::slotBaseColour]) << uri;
        ASSERT_EQ(loaded.meshReports.at(0).warnings.size(), 1u) << uri;
        EXPECT_NE(loaded.meshReports[0].warnings[0].find("#/images/0 is left out"), std::string::npos)
            << loaded.meshReports[0].warnings[0];
    }
}

} // namespace
} // namespace hyalite::core
