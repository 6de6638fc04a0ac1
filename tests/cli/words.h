// Command lines as they are typed, without a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hyalite::core::testing {

/// The words of a command line by the rules of sh: spaces separate; '...', "..." and \ quote; # begins a comment.
/// Throws std::runtime_error at what only a shell can do: | & ; < > ( ) $ ` * ? [ outside of quotes, ~ at the
/// beginning of a word, $ and ` between double quotes, or a quote without an end.
[[nodiscard]] std::vector<std::string> splitWords(std::string_view line);

} // namespace hyalite::core::testing
