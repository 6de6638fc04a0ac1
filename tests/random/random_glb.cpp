#include "tests/random/random_files.h"

#include "host/scene/limits.h"

namespace hyalite::core::testing {
namespace {

using nlohmann::json;

class GlbDraws {
  public:
    GlbDraws(Draws &draws, FileDraws &drawn, bool mayEmit)
        : draws_(draws), drawn_(drawn), mayEmit_(mayEmit) {}

    std::string add() {
        model_ = json::object();
        const int materialCount = draws_.whole(1, 2);
        for (int i = 0; i < materialCount; ++i)
            model_["materials"].push_back(glbMaterial());
        for (int i = 0; i < materialCount; ++i) {
            const Patch patch = drawn_.patch();
            json primitive{{"POSITION", patch.positions}, {"TEXCOORD_0", patch.uvs}};
            if (draws_.chance(0.95))
                primitive["material"] = i;
            const bool hasNormals = draws_.chance(0.7);
            const bool hasTangents = draws_.chance(0.4);
            const bool hasColours = draws_.chance(0.4);
            const bool hasSecond =
                model_.dump().find("texCoord\":1") != std::string::npos || draws_.chance(0.1);
            if (hasNormals)
                primitive["NORMAL"] = patch.normals;
            for (const json &uv : patch.uvs) {
                if (hasTangents)
                    primitive["TANGENT"].push_back(tangent());
                if (hasColours)
                    primitive["COLOR_0"].push_back(
                        {draws_.number(limits::fraction), draws_.number(limits::fraction),
                         draws_.number(limits::fraction), draws_.number(limits::fraction)});
                if (hasSecond)
                    primitive["TEXCOORD_1"].push_back({uv[1], 2.0 * uv[0].get<double>()});
            }
            for (const auto &triangle : patch.triangles)
                for (const int corner : triangle)
                    primitive["indices"].push_back(corner);
            model_["primitives"].push_back(primitive);
        }
        drawn_.add("model.glb", model_);
        return "model.glb";
    }

  private:
    json image(bool isNormal = false) {
        json model{{"uri", drawn_.addImage(isNormal)}};
        model_["images"].push_back(model);
        json texture{{"source", model_["images"].size() - 1}};
        if (draws_.chance(0.5)) {
            json sampler = json::object();
            constexpr int wraps[] = {10497, 33071, 33648};
            if (draws_.chance(0.5))
                sampler["wrapS"] = draws_.oneOf(wraps);
            if (draws_.chance(0.5))
                sampler["wrapT"] = draws_.oneOf(wraps);
            sampler["magFilter"] = 9728 + draws_.whole(0, 1);
            model_["samplers"].push_back(sampler);
            texture["sampler"] = model_["samplers"].size() - 1;
        }
        model_["textures"].push_back(texture);
        json info{{"index", model_["textures"].size() - 1}};
        if (draws_.chance(0.25))
            info["texCoord"] = 1;
        if (draws_.chance(0.3))
            info["extensions"]["KHR_texture_transform"] = {
                {"offset", {draws_.uniform(-1, 1), draws_.uniform(-1, 1)}},
                {"rotation", draws_.uniform(-3, 3)},
                {"scale", {draws_.uniform(-2, 2), draws_.uniform(-2, 2)}}};
        if (isNormal && draws_.chance(0.4))
            info["scale"] = draws_.uniform(0, 3);
        return info;
    }

    json three(double high) {
        return {draws_.number({0.0, high}), draws_.number({0.0, high}), draws_.number({0.0, high})};
    }

    json glbMaterial() {
        json material;
        json base = json::object();
        const auto maybe = [&](json &object, const char *key, double probability, const auto &draw) {
            if (draws_.chance(probability))
                object[key] = draw();
        };
        const auto fraction = [&] { return json(draws_.number(limits::fraction)); };
        const auto colour = [&] { return three(1.0); };
        const auto texture = [&] { return image(); };
        const auto normals = [&] { return image(true); };
        if (draws_.chance(0.6)) {
            base["baseColorFactor"] = colour();
            base["baseColorFactor"].push_back(draws_.number(limits::fraction));
        }
        maybe(base, "metallicFactor", 0.7, fraction);
        maybe(base, "roughnessFactor", 0.5, fraction);
        maybe(base, "baseColorTexture", 0.25, texture);
        maybe(base, "metallicRoughnessTexture", 0.2, texture);
        material["pbrMetallicRoughness"] = base;
        if (draws_.chance(0.6))
            material["alphaMode"] = draws_.oneOf(std::array{"OPAQUE", "MASK", "BLEND"});
        if (material.value("alphaMode", "") == "MASK")
            maybe(material, "alphaCutoff", 0.5, fraction);
        maybe(material, "doubleSided", 0.5, [&] { return json(draws_.chance(0.5)); });
        maybe(material, "normalTexture", 0.2, normals);
        if (mayEmit_ && draws_.chance(0.15)) {
            material["emissiveFactor"] = colour();
            maybe(material, "emissiveTexture", 0.3, texture);
        }
        const auto extension = [&](const char *name, double probability, const auto &fill) {
            if (draws_.chance(probability)) {
                json &object = material["extensions"][name] = json::object();
                fill(object);
            }
        };
        extension("KHR_materials_ior", 0.2, [&](json &it) { it["ior"] = draws_.uniform(1.0, 3.0); });
        extension("KHR_materials_specular", 0.2, [&](json &it) {
            maybe(it, "specularFactor", 0.5, fraction);
            maybe(it, "specularColorFactor", 0.5, colour);
            maybe(it, "specularTexture", 0.2, texture);
            maybe(it, "specularColorTexture", 0.2, texture);
        });
        extension("KHR_materials_transmission", 0.25, [&](json &it) {
            maybe(it, "transmissionFactor", 0.9, fraction);
            maybe(it, "transmissionTexture", 0.2, texture);
        });
        extension("KHR_materials_volume", 0.1, [&](json &it) {
            it = {{"thicknessFactor", 1}, {"attenuationDistance", 1}, {"attenuationColor", colour()}};
        });
        extension("KHR_materials_clearcoat", 0.25, [&](json &it) {
            maybe(it, "clearcoatFactor", 0.9, fraction);
            maybe(it, "clearcoatRoughnessFactor", 0.5, fraction);
            maybe(it, "clearcoatTexture", 0.2, texture);
            maybe(it, "clearcoatRoughnessTexture", 0.2, texture);
            maybe(it, "clearcoatNormalTexture", 0.3, normals);
        });
        extension("KHR_materials_sheen", 0.2, [&](json &it) {
            maybe(it, "sheenColorFactor", 0.9, colour);
            maybe(it, "sheenRoughnessFactor", 0.5, fraction);
            maybe(it, "sheenColorTexture", 0.2, texture);
            maybe(it, "sheenRoughnessTexture", 0.2, texture);
        });
        extension("KHR_materials_anisotropy", 0.2, [&](json &it) {
            maybe(it, "anisotropyStrength", 0.9, fraction);
            maybe(it, "anisotropyRotation", 0.5, [&] { return json(draws_.uniform(-3, 3)); });
            maybe(it, "anisotropyTexture", 0.3, texture);
        });
        extension("KHR_materials_iridescence", 0.2, [&](json &it) {
            const auto nanometres = [&] { return json(draws_.uniform(0.0, 900.0)); };
            maybe(it, "iridescenceFactor", 0.9, fraction);
            maybe(it, "iridescenceIor", 0.5, [&] { return json(draws_.uniform(1.0, 3.0)); });
            maybe(it, "iridescenceThicknessMinimum", 0.5, nanometres);
            maybe(it, "iridescenceThicknessMaximum", 0.5, nanometres);
            maybe(it, "iridescenceTexture", 0.2, texture);
            maybe(it, "iridescenceThicknessTexture", 0.3, texture);
        });
        extension("KHR_materials_dispersion", 0.2, [&](json &it) {
            maybe(it, "dispersion", 0.9, [&] { return json(draws_.uniform(0.0, 2.0)); });
        });
        extension("KHR_materials_diffuse_transmission", 0.2, [&](json &it) {
            maybe(it, "diffuseTransmissionFactor", 0.9, fraction);
            maybe(it, "diffuseTransmissionColorFactor", 0.5, colour);
            maybe(it, "diffuseTransmissionTexture", 0.2, texture);
            maybe(it, "diffuseTransmissionColorTexture", 0.3, texture);
        });
        extension("KHR_materials_pbrSpecularGlossiness", 0.1, [&](json &it) {
            maybe(it, "specularFactor", 0.5, colour);
            maybe(it, "glossinessFactor", 0.5, fraction);
            maybe(it, "diffuseTexture", 0.3, texture);
            maybe(it, "specularGlossinessTexture", 0.3, texture);
        });
        extension("KHR_materials_unlit", 0.07, [](json &) {});
        return material;
    }

    json tangent() {
        json vector = unitOf(1.0, draws_.uniform(-1, 1), draws_.uniform(-1, 1));
        vector.push_back(draws_.chance(0.5) ? 1 : -1);
        return vector;
    }

    Draws &draws_;
    FileDraws &drawn_;
    bool mayEmit_;
    json model_;
};

} // namespace

std::string drawGlb(Draws &draws, FileDraws &files, bool mayEmit) {
    return GlbDraws(draws, files, mayEmit).add();
}

} // namespace hyalite::core::testing
