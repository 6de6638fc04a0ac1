// The tables of materials, and what is made from them: the schema for editors and the tables of documents.
#include "host/scene/light_groups.h"
#include "host/scene/material.h"
#include "tests/fixtures/made_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>
#include <string>
#include <vector>

namespace hyalite::core {
namespace {

using Json = nlohmann::ordered_json;

std::string numberText(double number) { return fmt::format("{:.6g}", number); }

/// As it stands in a file of JSON: 0.1f is 0.1.
Json numberOf(double number) { return Json::parse(numberText(number)); }

std::string colourText(const glm::vec3 &colour) {
    if (colour.x == colour.y && colour.y == colour.z)
        return numberText(colour.x);
    return fmt::format("[{}, {}, {}]", numberText(colour.x), numberText(colour.y), numberText(colour.z));
}

/// What a material of the kind has where its keys are left out.
Material defaultOf(const MaterialRow &row) {
    Material material;
    material.roughness = row.defaultRoughness;
    return material;
}

bool isOfMetal(const ColourKey &colour) {
    return colour.member == &Material::conductorIndex || colour.member == &Material::conductorExtinction;
}

// For each kind of key: the values that are allowed, and the default, in words; and the keywords of JSON Schema.

std::string allowedText(const NumberKey &key) { return "number " + key.allowed.text(); }
std::string allowedText(const ColourKey &key) { return "colour " + key.allowed.text(); }
std::string allowedText(const WholeKey &key) { return "whole number " + key.allowed.text(); }
std::string allowedText(const FlagKey & /*key*/) { return "boolean"; }
std::string allowedText(const GroupKey & /*key*/) { return "1 to 32 letters, digits, `_` and `-`"; }
std::string allowedText(const SidesKey & /*key*/) { return "boolean"; }
std::string allowedText(const MetalKey & /*key*/) {
    std::vector<std::string> names;
    for (const auto &[name, metal] : metalNames)
        names.push_back(fmt::format("\"{}\"", name));
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string defaultText(const NumberKey &key, const Material &material) {
    return numberText(material.*key.member);
}
std::string defaultText(const ColourKey &key, const Material &material) {
    return isOfMetal(key) ? "that of the metal" : colourText(material.*key.member);
}
std::string defaultText(const WholeKey &key, const Material &material) {
    return numberText(material.*key.member);
}
std::string defaultText(const FlagKey &key, const Material &material) {
    return material.*key.member ? "true" : "false";
}
std::string defaultText(const GroupKey & /*key*/, const Material & /*material*/) {
    return fmt::format("\"{}\"", defaultLightGroup);
}
std::string defaultText(const SidesKey & /*key*/, const Material & /*material*/) { return "neither"; }
std::string defaultText(const MetalKey & /*key*/, const Material & /*material*/) {
    return fmt::format("\"{}\"", metalNames[0].first);
}

void addRange(Json &schema, const Interval &allowed) {
    schema[allowed.lowIncluded ? "minimum" : "exclusiveMinimum"] = numberOf(allowed.low);
    schema[allowed.highIncluded ? "maximum" : "exclusiveMaximum"] = numberOf(allowed.high);
}

void addSchema(Json &schema, const NumberKey &key, const Material &material) {
    schema["type"] = "number";
    addRange(schema, key.allowed);
    schema["default"] = numberOf(material.*key.member);
}
void addSchema(Json &schema, const ColourKey &key, const Material &material) {
    schema["type"] = {"array", "number"};
    addRange(schema, key.allowed);
    schema["minItems"] = 3;
    schema["maxItems"] = 3;
    schema["items"]["type"] = "number";
    addRange(schema["items"], key.allowed);
    if (!isOfMetal(key))
        schema["default"] = Json::parse(colourText(material.*key.member));
}
void addSchema(Json &schema, const WholeKey &key, const Material &material) {
    schema["type"] = "integer";
    addRange(schema, key.allowed);
    schema["default"] = material.*key.member;
}
void addSchema(Json &schema, const FlagKey &key, const Material &material) {
    schema["type"] = "boolean";
    schema["default"] = material.*key.member;
}
void addSchema(Json &schema, const GroupKey & /*key*/, const Material & /*material*/) {
    schema["type"] = "string";
    schema["pattern"] = "^[A-Za-z0-9_-]{1,32}$";
    schema["default"] = defaultLightGroup;
}
void addSchema(Json &schema, const SidesKey & /*key*/, const Material & /*material*/) {
    schema["type"] = "boolean";
}
void addSchema(Json &schema, const MetalKey & /*key*/, const Material & /*material*/) {
    for (const auto &[name, metal] : metalNames)
        schema["enum"].push_back(name);
    schema["default"] = metalNames[0].first;
}

/// Without the marks of Markdown.
std::string plain(std::string_view help) {
    std::string text(help);
    std::erase(text, '`');
    return text;
}

Json texturesSchema(std::uint32_t slots) {
    Json schema{{"description", "images, by what they are for; the numbers of the same names are factors on "
                                "theirs, and then 1 by default"},
                {"type", "object"},
                {"additionalProperties", false}};
    for (const auto &[name, slot, help] : textureSlots)
        if ((slots >> slot & 1u) != 0) {
            Json &image = schema["properties"][std::string(name)];
            image["$ref"] = slot == layout::slotNormal ? "#/$defs/normalMap" : "#/$defs/texture";
            if (!help.empty())
                image["description"] = help;
        }
    return schema;
}

/// The definitions of materials in the schema, as its file has them.
std::string schemaText() {
    Json kinds;
    kinds["material"] = {{"description", "what a surface is made of"},
                         {"type", "object"},
                         {"required", Json::array({"type"})}};
    for (const MaterialRow &row : materialTable) {
        const std::string name(row.name);
        kinds["material"]["oneOf"].push_back({{"$ref", "#/$defs/" + name}});
        Json &kind = kinds[name];
        kind = {{"description", plain(row.help)},
                {"type", "object"},
                {"additionalProperties", false},
                {"required", Json::array({"type"})}};
        kind["properties"]["type"]["const"] = name;
        for (const MaterialKey &key : row.keys) {
            Json &schema = kind["properties"][std::string(key.key)];
            schema["description"] = plain(key.help);
            std::visit([&](const auto &value) { addSchema(schema, value, defaultOf(row)); }, key.value);
        }
        if (row.textures != 0)
            kind["properties"]["textures"] = texturesSchema(row.textures);
    }
    std::string text;
    for (const auto &[name, kind] : kinds.items()) {
        std::string lines = kind.dump(2);
        for (std::size_t at = lines.find('\n'); at != std::string::npos; at = lines.find('\n', at + 1))
            lines.insert(at + 1, "    ");
        text += fmt::format("    \"{}\": {},\n", name, lines);
    }
    return text;
}

std::string slotsText(std::uint32_t slots) {
    std::vector<std::string> names;
    for (const auto &[name, slot, help] : textureSlots)
        if ((slots >> slot & 1u) != 0)
            names.push_back(fmt::format("`{}`", name));
    return fmt::format("{}", fmt::join(names, ", "));
}

/// The tables of documents, in Markdown.
std::string markdownText() {
    std::string text;
    for (const MaterialRow &row : materialTable) {
        text += fmt::format("\n**{}**: {}.\n", row.name, row.help);
        if (row.keys.empty())
            continue;
        text += "\n| key | value | default | meaning |\n|---|---|---|---|\n";
        for (const MaterialKey &key : row.keys)
            text += std::visit(
                [&](const auto &value) {
                    return fmt::format("| `{}` | {} | {} | {} |\n", key.key, allowedText(value),
                                       defaultText(value, defaultOf(row)), key.help);
                },
                key.value);
        if (row.textures != 0)
            text += fmt::format("| `textures` | object | | {}: see [textures](#textures) |\n",
                                slotsText(row.textures));
    }
    return text + "\n";
}

class MaterialTableCopy : public ::testing::TestWithParam<testing::MadeText> {};

TEST_P(MaterialTableCopy, IsWhatTheTableSays) { testing::expectMade(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Table, MaterialTableCopy,
                         ::testing::Values(testing::MadeText{"assets/hyalite-scene.schema.json",
                                                             "\"materialName\": {", "    \"texture\": {",
                                                             schemaText},
                                           testing::MadeText{"assets/README.md", "<!-- materials: begin",
                                                             "<!-- materials: end", markdownText}));

TEST(MaterialTable, HasARowForEachConstantOfTheLayout) {
    for (std::uint32_t kind = 0; kind <= layout::materialGltf; ++kind)
        EXPECT_EQ(static_cast<std::uint32_t>(materialTable.at(kind).kind), kind);
    ASSERT_EQ(materialTable.size(), layout::materialGltf + 2u);
    EXPECT_EQ(static_cast<std::uint32_t>(materialTable.back().kind) & layout::materialKindMask,
              layout::materialDiffuse); // a shadow catcher, to kernels
}

TEST(MaterialTable, KeysOfAKindAreUnique) {
    for (const MaterialRow &row : materialTable) {
        std::set<std::string_view> keys{"type", "textures"};
        for (const MaterialKey &key : row.keys)
            EXPECT_TRUE(keys.insert(key.key).second) << row.name << ": " << key.key;
    }
}

} // namespace
} // namespace hyalite::core
