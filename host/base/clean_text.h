// Clean text: untrusted text made safe for terminals and files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hyalite::core {

/// Valid UTF-8 without control characters except line feeds, without U+FFFE and U+FFFF, which XML forbids, and without
/// characters that change lines or the direction of text (Unicode Standard Annex 9, section 2), which can make one name
/// look like another. Every other byte or character becomes U+FFFD.
[[nodiscard]] std::string cleanText(std::string_view text);

/// An excerpt of a file for a message: clean, on one line, and cut after `maxBytes` with "...".
[[nodiscard]] std::string excerpt(std::string_view text, std::size_t maxBytes = 100);

/// `found "TEXT"; allowed: ALLOWED`: how a value that somebody gave is refused.
[[nodiscard]] std::string refusalText(std::string_view found, std::string_view allowed);

} // namespace hyalite::core
