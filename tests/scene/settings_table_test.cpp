// The table of settings, and what is made from it: the schema for editors and the tables of documents.
#include "host/scene/settings_table.h"
#include "tests/fixtures/made_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>

namespace hyalite::core {
namespace {

std::string numberText(double number) { return fmt::format("{:.10g}", number); }

std::string inQuotes(std::string_view text) { return nlohmann::json(text).dump(); }

template <class Number> std::string defaultText(const NumberSetting<Number> &number) {
    return numberText(static_cast<double>(RenderSettings{}.*number.member));
}
std::string defaultText(const FlagSetting &flag) { return RenderSettings{}.*flag.member ? "true" : "false"; }
template <class Value> std::string defaultText(const ChoiceSetting<Value> &choice) {
    return inQuotes(nameOf(RenderSettings{}.*choice.member));
}

template <class Value> std::vector<std::string> wordsOf(const ChoiceSetting<Value> &choice) {
    std::vector<std::string> words;
    for (const auto &[word, value] : choice.names)
        words.push_back(inQuotes(word));
    return words;
}

/// The keywords of JSON Schema for what is allowed, each a line.
template <class Number> std::vector<std::string> schemaOf(const NumberSetting<Number> &number) {
    const Interval &allowed = number.allowed;
    return {fmt::format("\"type\": \"{}\"", std::is_integral_v<Number> ? "integer" : "number"),
            fmt::format("\"{}\": {}", allowed.lowIncluded ? "minimum" : "exclusiveMinimum",
                        numberText(allowed.low)),
            fmt::format("\"{}\": {}", allowed.highIncluded ? "maximum" : "exclusiveMaximum",
                        numberText(allowed.high))};
}
std::vector<std::string> schemaOf(const FlagSetting &) { return {"\"type\": \"boolean\""}; }
template <class Value> std::vector<std::string> schemaOf(const ChoiceSetting<Value> &choice) {
    return {fmt::format("\"enum\": [{}]", fmt::join(wordsOf(choice), ", "))};
}

/// The settings of the schema, as its file has them.
std::string schemaText() {
    std::string text;
    for (const Setting &setting : settingsTable) {
        std::vector<std::string> lines{fmt::format("\"description\": {}", inQuotes(helpText(setting)))};
        std::visit(
            [&](const auto &value) {
                const std::vector<std::string> allowed = schemaOf(value);
                lines.insert(lines.end(), allowed.begin(), allowed.end());
                lines.push_back("\"default\": " + defaultText(value));
            },
            setting.value);
        text += fmt::format("        {}: {{\n          {}\n        }},\n", inQuotes(setting.key),
                            fmt::join(lines, ",\n          "));
    }
    return text;
}

template <class Number> std::string allowedText(const NumberSetting<Number> &number) {
    return fmt::format("{} {}", std::is_integral_v<Number> ? "whole number" : "number",
                       number.allowed.text());
}
std::string allowedText(const FlagSetting &) { return "boolean"; }
template <class Value> std::string allowedText(const ChoiceSetting<Value> &choice) {
    return fmt::format("{}", fmt::join(wordsOf(choice), ", "));
}

/// The table of documents, in Markdown.
std::string markdownText() {
    std::string text = "| key | option | values | default | meaning |\n|---|---|---|---|---|\n";
    for (const Setting &setting : settingsTable)
        std::visit(
            [&](const auto &value) {
                text += fmt::format("| `{}` | `--{}` | {} | {} | {} |\n", setting.key, setting.option,
                                    allowedText(value), defaultText(value), helpText(setting));
            },
            setting.value);
    return text;
}

class SettingsTableCopy : public ::testing::TestWithParam<testing::MadeText> {};

TEST_P(SettingsTableCopy, IsWhatTheTableSays) { testing::expectMade(GetParam()); }

// The schema's objects begin alike: what tells the one of settings is its first key.
INSTANTIATE_TEST_SUITE_P(Table, SettingsTableCopy,
                         ::testing::Values(testing::MadeText{"assets/hyalite-scene.schema.json",
                                                             "\"properties\": {\n        \"integrator\"",
                                                             "        \"shadowThroughGlass\"", schemaText},
                                           testing::MadeText{"assets/README.md", "<!-- settings: begin",
                                                             "<!-- settings: end", markdownText}));

TEST(SettingsTable, KeysAndOptionsAreUnique) {
    std::set<std::string_view> keys;
    std::set<std::string_view> options;
    for (const Setting &setting : settingsTable) {
        EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
        EXPECT_TRUE(options.insert(setting.option).second) << setting.option;
        EXPECT_TRUE(setting.group == imageGroup || setting.group == tracingGroup)
            << setting.key << ": its option would be in no group";
    }
}

template <class Number> void expectAllowedDefault(const NumberSetting<Number> &number) {
    EXPECT_TRUE(number.allowed.contains(static_cast<double>(RenderSettings{}.*number.member)));
}
void expectAllowedDefault(const FlagSetting &flag) { EXPECT_FALSE(RenderSettings{}.*flag.member); }
template <class Value> void expectAllowedDefault(const ChoiceSetting<Value> &choice) {
    EXPECT_NE(nameOf(RenderSettings{}.*choice.member), "");
}

TEST(SettingsTable, DefaultsAreAllowed) {
    for (const Setting &setting : settingsTable) {
        SCOPED_TRACE(setting.key);
        std::visit([](const auto &value) { expectAllowedDefault(value); }, setting.value);
    }
}

TEST(SettingsTable, ACheckpointMayBeResumedWithMoreSamplesAnotherTreeOrExposure) {
    std::set<std::string_view> free;
    for (const Setting &setting : settingsTable)
        if (setting.changes != Changes::Samples)
            free.insert(setting.key);
    for (const char *key : {"spp", "bvh", "leafSize", "exposure"})
        EXPECT_TRUE(free.contains(key)) << key;
    for (const char *key :
         {"integrator", "maxDepth", "occlusionDistance", "sampler", "filter", "seed", "clamp"})
        EXPECT_FALSE(free.contains(key)) << key;
}

TEST(SettingsTable, ARowSpeaksOfItsIntegrators) {
    for (const Setting &setting : settingsTable)
        for (const Integrator integrator : setting.integrators)
            EXPECT_NE(helpText(setting).find(nameOf(integrator)), std::string::npos) << setting.key;
}

TEST(SettingsTable, JsonHasEveryKeyInTheOrderOfTheTable) {
    RenderSettings settings;
    settings.tree = TreeKind::Sah;
    settings.seed = 4'000'000'000;
    const nlohmann::ordered_json json = settingsToJson(settings);
    ASSERT_EQ(json.size(), settingsTable.size());
    auto row = settingsTable.begin();
    for (const auto &[key, value] : json.items())
        EXPECT_EQ(key, (row++)->key);
    EXPECT_EQ(json["bvh"], "sah");
    EXPECT_EQ(json["seed"], 4'000'000'000);
}

} // namespace
} // namespace hyalite::core
