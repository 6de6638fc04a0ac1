// Scene options, one row each: what a command line, or a program that calls the engine, may set about a scene beside
// its settings (settings_table.h). To add one: its member in SceneOptions (prepare.h), its row here, and its use.
#pragma once

#include "host/base/clean_text.h"
#include "host/base/interval.h"
#include "host/base/json_reader.h"
#include "host/engine/prepare.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hyalite::core {

/// A number, or several, in a range; of integers if `Number` is one.
template <class Number> struct NumberOption {
    std::optional<Number> &(*member)(SceneOptions &);
    Interval allowed;
};
template <class Number> struct NumbersOption {
    std::vector<Number> &(*member)(SceneOptions &);
    Interval allowed;
    std::size_t count;
    bool isAxis = false; ///< words such as "-z" stand for the three numbers of an axis, too
};
/// A text that is not empty.
struct TextOption {
    std::string &(*member)(SceneOptions &);
    std::string_view allowed; ///< in words
    bool isFile = false;
};
/// A text such as "25%", which becomes a share in (0, 1].
struct PercentOption {
    std::optional<double> &(*member)(SceneOptions &);
    static constexpr Interval allowed{0.0, 100.0, false};
};
struct FlagOption {
    bool &(*member)(SceneOptions &);
};

struct SceneOption {
    std::string_view name; ///< on the command line, without dashes
    std::string_view group;
    std::string_view type; ///< of its value, in help texts
    std::variant<NumberOption<int>, NumberOption<double>, NumbersOption<int>, NumbersOption<double>,
                 TextOption, PercentOption, FlagOption>
        value;
    std::string_view help;
};

inline constexpr std::string_view viewGroup = "Camera and light";

/// In the order of help texts.
[[nodiscard]] std::span<const SceneOption> sceneOptions();

/// The three numbers of a word such as "-z"; empty for other words.
[[nodiscard]] std::vector<double> axisOf(std::string_view word);

/// The value of the word among `choices`, pairs of words and values. Throws OverrideError for other words; `name` is that
/// of what is chosen.
template <class Choices>
[[nodiscard]] auto chosenFrom(const Choices &choices, const std::string &word, std::string_view name) {
    std::vector<std::string_view> words;
    for (const auto &[known, value] : choices) {
        words.push_back(known);
        if (known == word)
            return value;
    }
    throw OverrideError(std::string(name), refusalText(word, quotedList(words) + suggestion(word, words)));
}

/// The change of a setting to a value.
template <class Value>
[[nodiscard]] SettingChange changeTo(Value value, Value RenderSettings::*member, const Setting &setting) {
    return {[member, value](RenderSettings &settings) { settings.*member = value; }, &setting};
}

/// Whether the option of this name is a file, which is read.
[[nodiscard]] bool namesFile(std::string_view name);

/// The value of an option or a setting, as programs have it.
using OptionValue = std::variant<bool, double, std::string, std::vector<double>>;

/// As the user would write it.
[[nodiscard]] std::string textOf(const OptionValue &value);

/// Sets the option or setting of this name, as the command line has it. Throws OverrideError for unknown names, and for
/// values that are not allowed.
void setSceneOption(SceneOptions &options, std::string_view name, const OptionValue &value);

/// All names that it knows, in the order of help texts.
[[nodiscard]] std::vector<std::string_view> sceneOptionNames();

} // namespace hyalite::core
