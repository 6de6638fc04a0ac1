#include "host/scene/settings_table.h"

#include "host/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace hyalite::core {

namespace {

template <class Number>
nlohmann::ordered_json toJson(const NumberSetting<Number> &number, const RenderSettings &settings) {
    return settings.*number.member;
}

nlohmann::ordered_json toJson(const FlagSetting &flag, const RenderSettings &settings) {
    return settings.*flag.member;
}

template <class Value>
nlohmann::ordered_json toJson(const ChoiceSetting<Value> &choice, const RenderSettings &settings) {
    return nameOf(settings.*choice.member);
}

template <class Number> Number valueFrom(const nlohmann::json &json, const NumberSetting<Number> &) {
    return json.get<Number>();
}

bool valueFrom(const nlohmann::json &json, const FlagSetting &) { return json.get<bool>(); }

template <class Value> Value valueFrom(const nlohmann::json &json, const ChoiceSetting<Value> &choice) {
    const auto name = std::ranges::find(choice.names, json.get<std::string>(), &Name<Value>::first);
    if (name == choice.names.end())
        throw Error(ErrorKind::BadInput, fmt::format("settings: {} is no word for any", json.dump()));
    return name->second;
}

} // namespace

std::string helpText(const Setting &setting) {
    if (std::holds_alternative<ChoiceSetting<Integrator>>(setting.value)) {
        std::vector<std::string> rows;
        rows.reserve(integratorNames.size());
        for (const auto &[name, integrator] : integratorNames) {
            const IntegratorRow &row = rowOf(integrator);
            rows.push_back(fmt::format("{}: {}", row.name, row.help));
        }
        return fmt::format("{}. {}", setting.help, fmt::join(rows, "; "));
    }
    if (setting.integrators.empty())
        return std::string(setting.help);
    std::vector<std::string_view> names;
    for (const Integrator integrator : setting.integrators)
        names.push_back(nameOf(integrator));
    return fmt::format("{}; for {} only", setting.help, fmt::join(names, ", "));
}

nlohmann::ordered_json settingToJson(const Setting &setting, const RenderSettings &settings) {
    return std::visit([&](const auto &value) { return toJson(value, settings); }, setting.value);
}

nlohmann::ordered_json settingsToJson(const RenderSettings &settings) {
    nlohmann::ordered_json json;
    for (const Setting &setting : settingsTable)
        json[std::string(setting.key)] = settingToJson(setting, settings);
    return json;
}

RenderSettings settingsFromJson(const nlohmann::json &json) {
    RenderSettings settings;
    for (const Setting &setting : settingsTable)
        std::visit(
            [&](const auto &value) { settings.*value.member = valueFrom(json.at(setting.key), value); },
            setting.value);
    return settings;
}

} // namespace hyalite::core
