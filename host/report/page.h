// HTML pages that need no network: a template with texts in it.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace hyalite::core {

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// JSON as an element `<script type="application/json">` may hold it: nothing in it ends the element.
[[nodiscard]] std::string scriptJson(const nlohmann::ordered_json &json);

/// A text, and the part of the template that it follows.
struct PagePart {
    std::string_view place;
    std::string_view text;
};

/// The template with all parts, whose places are there in this order. Texts are put in as they are.
[[nodiscard]] std::string filledPage(std::string_view page, std::initializer_list<PagePart> parts);

} // namespace hyalite::core
