// The materials of the tea table, as JSON. Each shows something of its own.
#pragma once

#include <string_view>

namespace tea_table {

// Indices of materials: their order below.
enum MaterialIndex {
    materialCloth,
    materialPaintedGlaze,
    materialGlaze,
    materialCopper,
    materialGlass,
    materialTea,
    materialThinGlass,
    materialLace,
    materialPearl,
    materialSugar,
    materialMacaron,
    materialSteam
};

// Textures have the numbers in which make_tea_table adds them.
inline constexpr std::string_view materials = R"("materials":[
{"name":"cloth","doubleSided":true,
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.9,"baseColorTexture":{"index":0,
  "extensions":{"KHR_texture_transform":{"scale":[9,9],"rotation":0.35}}}},
 "normalTexture":{"index":1,"extensions":{"KHR_texture_transform":{"scale":[40,40],"rotation":0.35}}},
 "extensions":{"KHR_materials_sheen":{"sheenColorFactor":[0.55,0.62,0.6],"sheenRoughnessFactor":0.45}}},
{"name":"painted glaze",
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.55,"baseColorTexture":{"index":2}},
 "extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":0.03}}},
{"name":"glaze",
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.55,"baseColorFactor":[0.85,0.80,0.68,1]},
 "extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":0.03}}},
{"name":"brushed copper",
 "pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0.3,"baseColorFactor":[0.93,0.60,0.44,1]},
 "extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.8,"anisotropyRotation":1.5707964}}},
{"name":"glass",
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},
 "extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.5},
  "KHR_materials_volume":{"thicknessFactor":0.002,"attenuationDistance":0.03,"attenuationColor":[0.78,0.92,0.88]}}},
{"name":"tea",
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},
 "extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.33},
  "KHR_materials_volume":{"thicknessFactor":0.05,"attenuationDistance":0.03,"attenuationColor":[0.88,0.42,0.10]}}},
{"name":"thin glass","doubleSided":true,
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0,"baseColorFactor":[0.97,0.99,0.98,1]},
 "extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}},
{"name":"lace","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.5,
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.9,"baseColorTexture":{"index":3}}},
{"name":"pearl",
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.35,"baseColorFactor":[0.82,0.76,0.70,1]},
 "extensions":{"KHR_materials_specular":{"specularFactor":1,"specularColorFactor":[2.0,1.5,1.7]},
  "KHR_materials_clearcoat":{"clearcoatFactor":0.7,"clearcoatRoughnessFactor":0.1}}},
{"name":"sugar",
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.6,"baseColorFactor":[0.9,0.89,0.87,1]},
 "normalTexture":{"index":4}},
{"name":"macaron",
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.7}},
{"name":"steam","doubleSided":true,"alphaMode":"BLEND",
 "pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":1,"baseColorFactor":[1,1,1,0.5],
  "baseColorTexture":{"index":5}}}],
)";

} // namespace tea_table
