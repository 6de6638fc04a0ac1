// Text of any origin, made fit for terminals and for files that others read.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hyalite {

/// Valid UTF-8 without control characters other than line feeds, and without those that change lines or the direction
/// of text (Unicode Standard Annex 9, section 2), which can make a name look like another: each byte and character that
/// is not becomes U+FFFD.
[[nodiscard]] std::string cleanText(std::string_view text);

/// A piece of a file for a message: clean, on one line, and cut behind `maxBytes`, where "..." stands for the rest.
[[nodiscard]] std::string excerpt(std::string_view text, std::size_t maxBytes = 100);

} // namespace hyalite
