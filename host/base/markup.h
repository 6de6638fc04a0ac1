// Text in markup.
#pragma once

#include <string>
#include <string_view>

namespace hyalite::core {

/// `text`, clean (clean_text.h) and escaped for elements and double-quoted attributes of HTML and XML.
[[nodiscard]] std::string markupText(std::string_view text);

} // namespace hyalite::core
