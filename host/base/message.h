// Messages on standard error.
#pragma once

#include "host/base/clean_text.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace hyalite {

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

} // namespace hyalite
