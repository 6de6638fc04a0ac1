#include "host/cli/scene_options.h"

#include "host/cli/options.h"
#include "host/engine/scene_options.h"
#include "host/scene/settings_table.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hyalite::core {

namespace {

template <class Number>
CLI::Option *addSetting(CLI::App &command, const std::string &name, const Setting &setting,
                        const NumberSetting<Number> &number, SettingChanges &changes) {
    const auto take = [&changes, &setting, member = number.member](Number given) {
        changes.push_back(changeTo(given, member, setting));
    };
    return addNumberFor<Number>(command, name, take, number.allowed, helpText(setting));
}

/// A share in percent, as `2%`.
double readShare(const std::string &name, const std::string &word, const Interval &percents) {
    if (!word.ends_with('%'))
        refuseValue(name, word, "a percentage, as 25%");
    return readNumber(name, word.substr(0, word.size() - 1), percents) / 100.0;
}

CLI::Option *addSetting(CLI::App &command, const std::string &name, const Setting &setting,
                        const ShareSetting &share, SettingChanges &changes) {
    const auto read = [&, name, member = share.member, allowed = share.allowed](const CLI::results_t &words) {
        const Interval percents{100.0 * allowed.low, 100.0 * allowed.high};
        changes.push_back(changeTo(readShare(name, words.front(), percents), member, setting));
        return true;
    };
    return command.add_option(name, CLI::callback_t(read), helpText(setting))->type_name("PERCENT%");
}

/// --NAME, or --NAME=false for what the scene has.
CLI::Option *addSetting(CLI::App &command, const std::string &name, const Setting &setting,
                        const FlagSetting &flag, SettingChanges &changes) {
    const auto take = [&changes, &setting, member = flag.member](std::int64_t count) {
        changes.push_back(changeTo(count > 0, member, setting));
    };
    return command.add_flag_function(name, take, helpText(setting));
}

template <class Value>
CLI::Option *addSetting(CLI::App &command, const std::string &name, const Setting &setting,
                        const ChoiceSetting<Value> &choice, SettingChanges &changes) {
    const auto take = [&changes, &setting, member = choice.member](Value given) {
        changes.push_back(changeTo(given, member, setting));
    };
    return addChoiceFor<Value>(command, name, take, choice.names, helpText(setting));
}

/// The settings of one group.
void addSettings(CLI::App &command, std::string_view group, SettingChanges &changes) {
    for (const Setting &setting : settingsTable)
        if (setting.group == group)
            std::visit(
                [&](const auto &value) {
                    return addSetting(command, fmt::format("--{}", setting.option), setting, value, changes);
                },
                setting.value)
                ->group(std::string(group));
}

/// Three numbers, or the word of an axis.
CLI::Option *addAxis(CLI::App &command, const std::string &name, std::vector<double> &axis,
                     const Interval &allowed, const std::string &help) {
    const auto read = [name, &axis, allowed](const CLI::results_t &words) {
        if (words.size() == 6)
            throw Error(ErrorKind::Usage, fmt::format("{} is given twice", name));
        if (words.size() == 1)
            axis = axisOf(words.front());
        if (words.size() != 3 && axis.empty())
            refuseValue(name, fmt::format("{}", fmt::join(words, ",")),
                        "three numbers, or x, y, z, -x, -y or -z");
        if (words.size() == 3)
            for (const std::string &word : words)
                axis.push_back(readNumber(name, word, allowed));
        return true;
    };
    return command.add_option(name, CLI::callback_t(read), help)
        ->delimiter(',')
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

/// Adds one option, by the kind of its row.
struct Adder {
    CLI::App &command;
    SceneOptions &options;
    const SceneOption &option;

    [[nodiscard]] std::string name() const { return fmt::format("--{}", option.name); }
    [[nodiscard]] std::string help() const { return std::string(option.help); }

    template <class Number> CLI::Option *operator()(const NumberOption<Number> &row) const {
        return addNumber(command, name(), row.member(options), row.allowed, help());
    }
    template <class Number> CLI::Option *operator()(const NumbersOption<Number> &row) const {
        return addNumbers(command, name(), row.member(options), row.allowed, std::string(option.type),
                          help());
    }
    CLI::Option *operator()(const NumbersOption<double> &row) const {
        std::vector<double> &member = row.member(options);
        return row.isAxis
                   ? addAxis(command, name(), member, row.allowed, help())
                   : addNumbers(command, name(), member, row.allowed, std::string(option.type), help());
    }
    CLI::Option *operator()(const TextOption &row) const {
        return addWord(command, name(), row.member(options), row.allowed, std::string(option.type), help());
    }
    CLI::Option *operator()(const PercentOption &row) const {
        const auto read = [name = name(), &share = row.member(options)](const CLI::results_t &words) {
            share = readShare(name, words.front(), PercentOption::allowed);
            return true;
        };
        return command.add_option(name(), CLI::callback_t(read), help());
    }
    CLI::Option *operator()(const FlagOption &row) const {
        return command.add_flag(name(), row.member(options), help());
    }
};

void addOptions(CLI::App &command, std::string_view group, SceneOptions &options) {
    for (const SceneOption &option : sceneOptions())
        if (option.group == group) {
            CLI::Option *added = std::visit(Adder{command, options, option}, option.value);
            added->group(std::string(group));
            if (!option.type.empty())
                added->type_name(std::string(option.type));
        }
}

} // namespace

void addSceneOptions(CLI::App &command, SceneOptions &options) {
    command
        .add_option("scene", options.scene,
                    "a .json, .gltf or .glb scene, a .obj, .ply or .stl mesh, "
                    "the name of a shipped scene, or - for standard input")
        ->required()
        ->type_name("SCENE");
    addPaths(command, "--allow-path", options.load.allowedPaths,
             "also let a scene file read this file, or files in this folder; repeatable");
    addOptions(command, imageGroup, options);
    addSettings(command, imageGroup, options.settings);
    addOptions(command, viewGroup, options);
    addSettings(command, tracingGroup, options.settings);
    addOptions(command, tracingGroup, options);
}

} // namespace hyalite::core
