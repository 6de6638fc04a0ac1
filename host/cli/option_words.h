// The words for options and arguments, as help pages, the manual and completions show them.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace hyalite::core {

/// "SCENE"
[[nodiscard]] std::string positionalName(const CLI::Option &option);
/// "-o,--output FILE"
[[nodiscard]] std::string nameWithValue(const CLI::Option &option);
/// The description, and whether it is required or what its default is.
[[nodiscard]] std::string explanationOf(const CLI::Option &option);
/// Those that are not hidden, without the positional ones.
[[nodiscard]] std::vector<const CLI::Option *> shownOptions(const CLI::App &app);
[[nodiscard]] std::vector<const CLI::Option *> positionalsOf(const CLI::App &app);

} // namespace hyalite::core
