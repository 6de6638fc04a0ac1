// The manual page and the completion of command lines, made from the commands and their options.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace hyalite::core {

/// A page for section 1 of man(1), as roff with the macros of man(7).
[[nodiscard]] std::string manualPage(const CLI::App &app);

/// A script for bash that completes commands, options, and the values of options with a few words.
[[nodiscard]] std::string bashCompletion(const CLI::App &app);

} // namespace hyalite::core
