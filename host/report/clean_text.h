// Text of any origin, made fit for files that others read.
#pragma once

#include <string>
#include <string_view>

namespace hyalite {

/// Valid UTF-8 without control characters other than line feeds: each byte and character that is not becomes U+FFFD.
[[nodiscard]] std::string cleanText(std::string_view text);

} // namespace hyalite
