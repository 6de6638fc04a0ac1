#include "host/report/page.h"

#include "host/base/json_text.h"

#include <cassert>

namespace hyalite::core {

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string scriptJson(const nlohmann::ordered_json &json) {
    // A "<", which only strings have, could end the element.
    const std::string plain = jsonText(json);
    std::string text;
    text.reserve(plain.size());
    for (const char letter : plain)
        if (letter == '<')
            text += "\\u003c";
        else
            text += letter;
    return text;
}

std::string filledPage(std::string_view page, std::initializer_list<PagePart> parts) {
    std::string html;
    for (const PagePart &part : parts) {
        const std::size_t place = page.find(part.place);
        assert(place != std::string_view::npos);
        const std::size_t end = place + part.place.size();
        html.append(page.substr(0, end)).append(part.text);
        page.remove_prefix(end);
    }
    return html.append(page);
}

} // namespace hyalite::core
