// What is said to people on standard error.
#pragma once

#include "host/base/clean_text.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace hyalite {

/// Prints on standard error. Names from files may be in it: a terminal must not obey them. A message that is lost,
/// because nobody reads it or a disk is full, stops no work.
template <class... Arguments>
void printMessage(fmt::format_string<Arguments...> format, Arguments &&...arguments) {
    const std::string text = cleanText(fmt::format(format, std::forward<Arguments>(arguments)...));
    std::fwrite(text.data(), 1, text.size(), stderr);
}

} // namespace hyalite
