// Options by kind: numbers, vectors, words and files, read the same way by all commands.
//
// An invalid value throws Error{Usage} "--spp: found "0"; allowed: a whole number from 1 to 65536". Each function
// adds an option to `command`, which sets `value` when it is parsed: `value` must outlive the command.
#pragma once

#include "host/base/error.h"
#include "host/base/json_reader.h"
#include "host/image/file_options.h"
#include "host/image/image_file.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {

/// Throws Error{Usage}.
[[noreturn]] void refuseValue(const std::string &option, std::string_view found, std::string_view allowed);

/// The number in `text`, which may have blanks around it. Throws Error{Usage} for other text and numbers out of range.
[[nodiscard]] double readNumber(const std::string &option, std::string_view text, const Interval &allowed);
/// The same for whole numbers; 1.5 and 1e3 are none.
[[nodiscard]] std::int64_t readWholeNumber(const std::string &option, std::string_view text,
                                           const Interval &allowed);

template <class Number>
[[nodiscard]] Number readAs(const std::string &option, std::string_view text, const Interval &allowed) {
    if constexpr (std::integral<Number>)
        return static_cast<Number>(readWholeNumber(option, text, allowed));
    else
        return readNumber(option, text, allowed);
}

template <class Value> struct NumberIn { using Type = Value; };
template <class Number> struct NumberIn<std::optional<Number>> { using Type = Number; };

/// An option with one number, which is passed to `take`. Its type decides whether it is whole.
template <class Number>
CLI::Option *addNumberFor(CLI::App &command, const std::string &name, const std::function<void(Number)> &take,
                          const Interval &allowed, const std::string &help) {
    const auto read = [name, take, allowed](const CLI::results_t &words) {
        take(readAs<Number>(name, words.front(), allowed));
        return true;
    };
    return command.add_option(name, CLI::callback_t(read), help)
        ->type_name(std::integral<Number> ? "N" : "NUMBER");
}

/// The same for a variable: Value is a number or optional.
template <class Value>
CLI::Option *addNumber(CLI::App &command, const std::string &name, Value &value, const Interval &allowed,
                       const std::string &help) {
    using Number = typename NumberIn<Value>::Type;
    return addNumberFor<Number>(
        command, name, [&value](Number number) { value = number; }, allowed, help);
}

/// An option with one number for each word of `typeName`: `--up 0,1,0` for "X,Y,Z".
template <class Number>
CLI::Option *addNumbers(CLI::App &command, const std::string &name, std::vector<Number> &values,
                        const Interval &allowed, const std::string &typeName, const std::string &help) {
    const auto count = static_cast<std::size_t>(1 + std::count(typeName.begin(), typeName.end(), ','));
    const auto read = [name, &values, allowed, count](const CLI::results_t &words) {
        if (words.size() > count && words.size() % count == 0)
            throw Error(ErrorKind::Usage, fmt::format("{} is given twice", name));
        if (words.size() != count)
            refuseValue(name, fmt::format("{}", fmt::join(words, ",")), fmt::format("{} numbers", count));
        for (const std::string &word : words)
            values.push_back(readAs<Number>(name, word, allowed));
        return true;
    };
    return command.add_option(name, CLI::callback_t(read), help)
        ->delimiter(',')
        ->expected(static_cast<int>(count))
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll) // a wrong count is reported here
        ->type_name(typeName);
}

/// An option with one of a few words; its value is passed to `take`. `choices` must outlive the command.
template <class Value>
CLI::Option *addChoiceFor(CLI::App &command, const std::string &name, const std::function<void(Value)> &take,
                          std::span<const Name<Value>> choices, const std::string &help) {
    std::vector<std::string_view> words;
    for (const auto &[word, meaning] : choices)
        words.push_back(word);
    const std::string typeName = fmt::format("{}", fmt::join(words, "|"));
    const auto read = [name, take, choices, words = std::move(words)](const CLI::results_t &typed) {
        const auto chosen = std::ranges::find(words, typed.front());
        if (chosen == words.end())
            refuseValue(name, typed.front(), quotedList(words) + suggestion(typed.front(), words));
        take(choices[static_cast<std::size_t>(chosen - words.begin())].second);
        return true;
    };
    return command.add_option(name, CLI::callback_t(read), help)->type_name(typeName);
}

/// The same for a variable.
template <class Value, std::size_t count>
CLI::Option *addChoice(CLI::App &command, const std::string &name, std::optional<Value> &value,
                       const std::array<Name<Value>, count> &choices, const std::string &help) {
    return addChoiceFor<Value>(
        command, name, [&value](Value chosen) { value = chosen; }, choices, help);
}

/// An option with the name of a file, not empty, that is written: "-" is standard output, and results then go to
/// standard error.
CLI::Option *addOutput(CLI::App &command, const std::string &name, std::string &path,
                       const std::string &typeName, const std::string &help);

/// An option with a file name, which must not be empty.
CLI::Option *addFile(CLI::App &command, const std::string &name, std::string &path,
                     const std::string &typeName, const std::string &help);

/// An option with a text that must not be empty. `allowed`, which must outlive the command, says in words what it is.
CLI::Option *addWord(CLI::App &command, const std::string &name, std::string &word, std::string_view allowed,
                     const std::string &typeName, const std::string &help);

/// An option that may be repeated, each time with an existing folder or file.
CLI::Option *addPaths(CLI::App &command, const std::string &name, std::vector<std::filesystem::path> &paths,
                      const std::string &help);

/// --tone, for commands that write a PNG. `curve` must outlive the command; it is empty for the default.
CLI::Option *addToneOption(CLI::App &command, std::optional<ToneCurve> &curve);

/// The same, and the options of an EXR, for commands that write either. `file` must outlive the command.
void addFileOptions(CLI::App &command, FileRequest &file);

/// The option of the file that was given, or an empty text.
[[nodiscard]] std::string_view givenOption(const FileRequest &file);

/// Throws Error{Usage} for an option that `output` has not, which is of the format.
void requireFileOptions(const FileRequest &file, ImageFormat format, const std::string &output);

/// The range of times.
inline constexpr Interval anySeconds{0.0, 1e9, false};

/// --time-limit. `help` says what ends.
CLI::Option *addTimeLimit(CLI::App &command, std::optional<double> &seconds, const std::string &help);

/// A file option as the user gave it; the path is empty without the option.
struct NamedFile {
    std::string option;
    std::string path;
};

/// Throws Error{Usage} if two outputs are the same file, or if an output would replace an input.
void requireDistinctFiles(const std::vector<NamedFile> &outputs, const std::vector<std::string> &inputs);

/// Adds --display, the address of a viewer.
void addDisplayOption(CLI::App &command, std::string &address);

} // namespace hyalite::core
