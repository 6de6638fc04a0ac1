#include "host/import/gltf/materials.h"

#include "host/scene/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

namespace hyalite::core::gltf {
namespace {

constexpr auto alphaModes = std::to_array<std::pair<std::string_view, AlphaMode>>(
    {{"OPAQUE", AlphaMode::Opaque}, {"MASK", AlphaMode::CutOut}, {"BLEND", AlphaMode::Blend}});

/// Reads one material.
class MaterialReader {
  public:
    MaterialReader(const Document &document, const JsonNode &node, TextureReader &textures)
        : document_(document), node_(node), object_(node), textures_(textures) {
        material_.kind = MaterialKind::Gltf;
    }

    Material read() {
        material_.name = nameOf(object_);
        if (material_.name.empty())
            material_.name = node_.path.to_string();
        readBase();
        if (const auto glossy = extensionOf(object_, "KHR_materials_pbrSpecularGlossiness"))
            readSpecularGlossiness(*glossy);
        readAlpha();
        readSurface();
        readSpecular();
        readTransmission();
        readDispersion();
        readClearcoat();
        readSheen();
        readAnisotropy();
        readIridescence();
        readDiffuseTransmission();
        material_.isUnlit = extensionOf(object_, "KHR_materials_unlit").has_value();
        const bool isDoubleSided = object_.boolean("doubleSided", false);
        material_.twoSided = isDoubleSided;
        material_.isCulled = !isDoubleSided && material_.transmission == 0.0f &&
                             material_.diffuseTransmission == 0.0f && material_.isThin;
        return std::move(material_);
    }

  private:
    [[nodiscard]] float number(const JsonObject &object, std::string_view key, const Interval &allowed,
                               double fallback) const {
        return static_cast<float>(clampedNumber(document_, object, key, allowed, fallback));
    }

    [[nodiscard]] glm::vec3 colour(const JsonObject &object, std::string_view key, const Interval &allowed,
                                   double fallback) const {
        const std::optional<JsonNode> node = object.find(key);
        if (!node)
            return glm::vec3(static_cast<float>(fallback));
        const std::vector<double> numbers = clampedNumbers(document_, *node, 3, allowed);
        return glm::vec3(glm::dvec3(numbers[0], numbers[1], numbers[2]));
    }

    /// Puts the texture of a member into a slot.
    void wear(std::uint32_t slot, const JsonObject &object, std::string_view key,
              Channel channel = Channel::Red) {
        const std::optional<JsonNode> info = object.find(key);
        if (!info)
            return;
        std::optional<TextureUse> use = textures_.read(*info);
        if (!use)
            return;
        use->channel = channel;
        material_.textures[slot] = *use;
    }

    void readFactors(const JsonObject &object, std::string_view factorKey) {
        const std::optional<JsonNode> factor = object.find(factorKey);
        const std::vector<double> numbers =
            factor ? clampedNumbers(document_, *factor, 4, limits::fraction) : std::vector<double>(4, 1.0);
        material_.albedo = glm::vec3(glm::dvec3(numbers[0], numbers[1], numbers[2]));
        material_.opacity = static_cast<float>(numbers[3]);
    }

    void readBase() {
        material_.albedo = glm::vec3(1.0f);
        material_.metallic = 1.0f;
        material_.roughness = 1.0f;
        const std::optional<JsonNode> node = object_.find("pbrMetallicRoughness");
        if (!node)
            return;
        const JsonObject base(*node);
        readFactors(base, "baseColorFactor");
        wear(layout::slotBaseColour, base, "baseColorTexture");
        material_.metallic = number(base, "metallicFactor", limits::fraction, 1.0);
        material_.roughness = number(base, "roughnessFactor", limits::fraction, 1.0);
        wear(layout::slotRoughness, base, "metallicRoughnessTexture", Channel::Green);
        wear(layout::slotMetallic, base, "metallicRoughnessTexture", Channel::Blue);
    }

    /// In place of the base. With a texture, `roughness` is the factor on its alpha, which is glossiness.
    void readSpecularGlossiness(const JsonObject &glossy) {
        material_.isSpecularGlossy = true;
        material_.metallic = 0.0f;
        for (const std::uint32_t slot : {layout::slotBaseColour, layout::slotRoughness, layout::slotMetallic})
            material_.textures[slot].reset();
        readFactors(glossy, "diffuseFactor");
        wear(layout::slotBaseColour, glossy, "diffuseTexture");
        material_.dielectricColour = colour(glossy, "specularFactor", limits::fraction, 1.0);
        wear(layout::slotDielectricColour, glossy, "specularGlossinessTexture");
        wear(layout::slotRoughness, glossy, "specularGlossinessTexture", Channel::Alpha);
        const float glossiness = number(glossy, "glossinessFactor", limits::fraction, 1.0);
        material_.roughness = material_.textures[layout::slotRoughness] ? glossiness : 1.0f - glossiness;
    }

    void readAlpha() {
        material_.alphaMode = object_.choice("alphaMode", alphaModes, AlphaMode::Opaque);
        material_.alphaCutoff = number(object_, "alphaCutoff", {0.0, 1e30}, 0.5);
        const std::optional<TextureUse> &base = material_.textures[layout::slotBaseColour];
        if (material_.alphaMode == AlphaMode::Opaque) {
            material_.opacity = 1.0f;
        } else if (base && textures_.hasAlpha(*base)) {
            material_.textures[layout::slotOpacity] = base;
            material_.textures[layout::slotOpacity]->channel = Channel::Alpha;
        }
    }

    /// Textures that the format knows and that nothing is made of.
    void tellUnused(const JsonObject &object, std::string_view key, std::string_view reason) {
        if (const std::optional<JsonNode> node = object.find(key))
            document_.losses().add(key, [&] {
                return fmt::format("{}: {}: left out: {}", *node->fileName, node->path.to_string(), reason);
            });
    }

    void readSurface() {
        tellUnused(object_, "occlusionTexture", "how much light reaches a place is computed");
        wear(layout::slotNormal, object_, "normalTexture");
        if (material_.textures[layout::slotNormal])
            material_.normalStrength = readStrength(object_, "normalTexture");
        double strength = 1.0;
        if (const auto emissive = extensionOf(object_, "KHR_materials_emissive_strength"))
            strength = clampedNumber(document_, *emissive, "emissiveStrength", limits::radiance, 1.0);
        material_.emission =
            colour(object_, "emissiveFactor", limits::fraction, 0.0) * static_cast<float>(strength);
        if (material_.emission != glm::vec3(0.0f))
            wear(layout::slotEmission, object_, "emissiveTexture");
    }

    [[nodiscard]] float readStrength(const JsonObject &object, std::string_view key) {
        const double most = limits::normalStrength.high;
        const float strength = number(JsonObject(object.at(key)), "scale", {-most, most}, 1.0);
        if (strength < 0.0f)
            document_.losses().add("negative scale", [&] {
                return fmt::format("{}: {}: its normal map turns normals the wrong way by a scale of {}, "
                                   "which counts as {}",
                                   *node_.fileName, node_.path.to_string(), strength, -strength);
            });
        return std::abs(strength);
    }

    void readSpecular() {
        if (const auto specular = extensionOf(object_, "KHR_materials_specular");
            specular && !material_.isSpecularGlossy) {
            material_.dielectricWeight = number(*specular, "specularFactor", limits::fraction, 1.0);
            material_.dielectricColour = colour(*specular, "specularColorFactor", limits::radiance, 1.0);
            wear(layout::slotDielectricWeight, *specular, "specularTexture", Channel::Alpha);
            wear(layout::slotDielectricColour, *specular, "specularColorTexture");
        }
        const auto ior = extensionOf(object_, "KHR_materials_ior");
        if (!ior)
            return;
        double index = ior->number("ior", {0.0, 1e6}, 1.5);
        constexpr double nearlyOne = 0.999; // what is less is no rounding of an index from 1 on
        if (index > 0.0 && index < nearlyOne)
            ior->at("ior").refuse("0, or a number from 1 on");
        if (index > 0.0)
            index = std::max(index, 1.0);
        const double most = limits::refractiveIndex.high;
        material_.refractiveIndex = static_cast<float>(index == 0.0 ? most : std::min(index, most));
        if (index == 0.0 && !material_.isSpecularGlossy) // by definition everything is reflected head on
            material_.dielectricColour *= static_cast<float>(std::pow((most + 1.0) / (most - 1.0), 2.0));
        if (index > most)
            document_.losses().add("refractive index", [&] {
                return fmt::format("{}: {}: its refractive index of {} counts as {}", *node_.fileName,
                                   node_.path.to_string(), index, most);
            });
    }

    void readTransmission() {
        material_.isThin = true;
        if (const auto transmission = extensionOf(object_, "KHR_materials_transmission")) {
            material_.transmission = number(*transmission, "transmissionFactor", limits::fraction, 0.0);
            wear(layout::slotTransmission, *transmission, "transmissionTexture", Channel::Red);
        }
        const auto volume = extensionOf(object_, "KHR_materials_volume");
        if (!volume)
            return;
        tellUnused(*volume, "thicknessTexture", "light goes as far through glass as the mesh is thick");
        material_.isThin =
            !(clampedNumber(document_, *volume, "thicknessFactor", limits::radiance, 0.0) > 0.0);
        const std::optional<JsonNode> distance = volume->find("attenuationDistance");
        if (!distance || material_.isThin)
            return;
        const double length = distance->number({0.0, 1e30, false});
        const glm::vec3 tint = colour(*volume, "attenuationColor", limits::fraction, 1.0);
        for (glm::length_t channel = 0; channel < 3; ++channel)
            material_.absorption[channel] = absorptionOf(static_cast<double>(tint[channel]), length);
    }

    /// Of a volume alone: what is thin bends no light.
    void readDispersion() {
        const auto dispersion = extensionOf(object_, "KHR_materials_dispersion");
        if (dispersion && isGlass(material_))
            material_.dispersion = number(*dispersion, "dispersion", limits::dispersion, 0.0);
    }

    /// Beer's law: light is dimmed by `tint` over the length. A tint of 0 counts as 1e-6.
    static float absorptionOf(double tint, double length) {
        const double absorption = -std::log(std::max(tint, 1e-6)) / length;
        return static_cast<float>(std::clamp(absorption, 0.0, limits::absorption.high));
    }

    void readClearcoat() {
        const auto coat = extensionOf(object_, "KHR_materials_clearcoat");
        if (!coat)
            return;
        material_.clearcoat = number(*coat, "clearcoatFactor", limits::fraction, 0.0);
        material_.clearcoatRoughness = number(*coat, "clearcoatRoughnessFactor", limits::fraction, 0.0);
        if (material_.clearcoat == 0.0f)
            return;
        wear(layout::slotClearcoat, *coat, "clearcoatTexture", Channel::Red);
        wear(layout::slotClearcoatRoughness, *coat, "clearcoatRoughnessTexture", Channel::Green);
        wear(layout::slotClearcoatNormal, *coat, "clearcoatNormalTexture");
        if (material_.textures[layout::slotClearcoatNormal])
            material_.clearcoatNormalStrength = readStrength(*coat, "clearcoatNormalTexture");
    }

    void readSheen() {
        const auto sheen = extensionOf(object_, "KHR_materials_sheen");
        if (!sheen)
            return;
        material_.sheenColour = colour(*sheen, "sheenColorFactor", limits::fraction, 0.0);
        material_.sheenRoughness = number(*sheen, "sheenRoughnessFactor", limits::fraction, 0.0);
        if (material_.sheenColour == glm::vec3(0.0f))
            return;
        wear(layout::slotSheenColour, *sheen, "sheenColorTexture");
        wear(layout::slotSheenRoughness, *sheen, "sheenRoughnessTexture", Channel::Alpha);
    }

    void readAnisotropy() {
        const auto anisotropy = extensionOf(object_, "KHR_materials_anisotropy");
        if (!anisotropy)
            return;
        material_.anisotropy = number(*anisotropy, "anisotropyStrength", limits::fraction, 0.0);
        material_.anisotropyRotation = number(*anisotropy, "anisotropyRotation", {-1e6, 1e6}, 0.0);
        if (material_.anisotropy > 0.0f)
            wear(layout::slotAnisotropy, *anisotropy, "anisotropyTexture", Channel::Blue);
    }

    void readIridescence() {
        const auto film = extensionOf(object_, "KHR_materials_iridescence");
        if (!film)
            return;
        const auto index = number(*film, "iridescenceIor", limits::refractiveIndex, 1.3);
        const auto least = number(*film, "iridescenceThicknessMinimum", limits::filmThickness, 100.0);
        const auto most = number(*film, "iridescenceThicknessMaximum", limits::filmThickness, 400.0);
        material_.iridescence = number(*film, "iridescenceFactor", limits::fraction, 0.0);
        if (material_.iridescence == 0.0f)
            return;
        material_.iridescenceIndex = index;
        material_.iridescenceThicknessMinimum = least;
        material_.iridescenceThickness = most;
        wear(layout::slotIridescence, *film, "iridescenceTexture", Channel::Red);
        wear(layout::slotIridescenceThickness, *film, "iridescenceThicknessTexture", Channel::Green);
    }

    void readDiffuseTransmission() {
        const auto diffuse = extensionOf(object_, "KHR_materials_diffuse_transmission");
        if (!diffuse)
            return;
        const glm::vec3 tint = colour(*diffuse, "diffuseTransmissionColorFactor", limits::fraction, 1.0);
        material_.diffuseTransmission = number(*diffuse, "diffuseTransmissionFactor", limits::fraction, 0.0);
        if (material_.diffuseTransmission == 0.0f)
            return;
        material_.diffuseTransmissionColour = tint;
        wear(layout::slotDiffuseTransmission, *diffuse, "diffuseTransmissionTexture", Channel::Alpha);
        wear(layout::slotDiffuseTransmissionColour, *diffuse, "diffuseTransmissionColorTexture");
    }

    const Document &document_;
    JsonNode node_;
    JsonObject object_;
    TextureReader &textures_;
    Material material_;
};

/// glTF 2.0, section 3.9.6 and 5.19: the defaults of a material.
Material defaultMaterial() {
    Material material;
    material.name = "default";
    material.kind = MaterialKind::Gltf;
    material.albedo = glm::vec3(1.0f);
    material.metallic = 1.0f;
    material.roughness = 1.0f;
    material.alphaMode = AlphaMode::Opaque;
    material.isThin = true;
    material.isCulled = true;
    return material;
}

/// What the file says of a volume of glass, without its name and its thickness, which is that of the mesh.
nlohmann::json descriptionOf(const JsonNode &node) {
    nlohmann::json description = *node.value;
    description.erase("name");
    nlohmann::json &volume = description["extensions"]["KHR_materials_volume"];
    volume.erase("thicknessFactor");
    volume.erase("thicknessTexture");
    return description;
}

/// Lets equal volumes be one where there are more than `path` tells apart, and makes those thin that are beyond.
void limitVolumes(const Document &document, Materials &materials) {
    if (std::cmp_less_equal(std::ranges::count_if(materials.list, holdsMedium), limits::mediumCount))
        return;
    std::map<nlohmann::json, std::uint32_t> volumes;
    std::uint32_t index = 0;
    for (const JsonNode &node : elementsOf(document.top(), "materials")) {
        Material &material = materials.list[index];
        if (holdsMedium(material)) {
            const auto [alike, isNew] = volumes.try_emplace(descriptionOf(node), index);
            materials.shownAs[index] = alike->second;
            if (!isNew || volumes.size() > limits::mediumCount) {
                material.isThin = true;
                material.absorption = glm::vec3(0.0f);
            }
        }
        ++index;
    }
    if (volumes.size() > limits::mediumCount)
        document.losses().add("volumes", [&] {
            return fmt::format(
                "{}: {} materials are glass with volumes that differ; those after the first {} "
                "count as thin glass",
                document.fileName(), volumes.size(), limits::mediumCount);
        });
}

} // namespace

Materials readMaterials(const Document &document, TextureReader &textures) {
    Materials materials;
    for (const JsonNode &node : document.top().elements("materials", limits::materialCount - 2))
        materials.list.push_back(MaterialReader(document, node, textures).read());
    materials.list.push_back(defaultMaterial());
    materials.shownAs.resize(materials.list.size());
    std::iota(materials.shownAs.begin(), materials.shownAs.end(), 0u);
    limitVolumes(document, materials);
    return materials;
}

} // namespace hyalite::core::gltf
