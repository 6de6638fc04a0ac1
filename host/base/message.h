// Messages on standard error, and results on standard output.
#pragma once

#include "host/base/clean_text.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace hyalite::core {

/// Prints on standard error, without terminal escapes, which names from files could contain. A message that cannot be
/// written, to a closed pipe or a full disk, is not an error.
template <class... Arguments>
void printMessage(fmt::format_string<Arguments...> format, Arguments &&...arguments) {
    const std::string text = cleanText(fmt::format(format, std::forward<Arguments>(arguments)...));
    std::fwrite(text.data(), 1, text.size(), stderr);
}

/// A warning, one line: "hyalite: warning: ...".
template <class... Arguments>
void printWarning(fmt::format_string<Arguments...> format, Arguments &&...arguments) {
    printMessage("hyalite: warning: {}\n", fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Where results go: standard output, or standard error once a file goes to standard output.
inline std::FILE *resultStream = stdout;

/// An argument of printResult(): texts on one line, without control characters.
template <class Argument> auto shownArgument(const Argument &argument) {
    if constexpr (std::is_convertible_v<const Argument &, std::string_view>) {
        const std::string_view text = argument;
        return excerpt(text, text.size());
    } else {
        return argument;
    }
}

/// Prints on `resultStream`. Texts among the arguments may be names from files: each stays on its line.
template <class... Arguments>
void printResult(fmt::format_string<decltype(shownArgument(std::declval<const Arguments &>()))...> format,
                 const Arguments &...arguments) {
    fmt::print(resultStream, "{}", fmt::format(format, shownArgument(arguments)...));
}

} // namespace hyalite::core
