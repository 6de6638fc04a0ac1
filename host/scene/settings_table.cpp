#include "host/scene/settings_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hyalite {

namespace {

template <class Number>
nlohmann::ordered_json toJson(const NumberSetting<Number> &number, const RenderSettings &settings) {
    return settings.*number.member;
}

template <class Value>
nlohmann::ordered_json toJson(const ChoiceSetting<Value> &choice, const RenderSettings &settings) {
    return nameOf(settings.*choice.member);
}

} // namespace

std::string helpText(const Setting &setting) {
    if (std::holds_alternative<ChoiceSetting<Integrator>>(setting.value)) {
        std::vector<std::string> rows;
        rows.reserve(integratorTable.size());
        for (const IntegratorRow &row : integratorTable)
            rows.push_back(fmt::format("{}: {}", row.name, row.help));
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

} // namespace hyalite
