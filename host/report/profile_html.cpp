#include "host/report/profile_html.h"

#include "host/base/json_text.h"
#include "host/report/profile_json.h"
#include "host/report/profile_page.h"

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

std::string profileHtml(const Profile &profile, std::span<const std::byte> png,
                        std::span<const std::byte> heatMapPng) {
    nlohmann::ordered_json report = profileToJson(profile);
    report["picture"] = base64(png);
    if (!heatMapPng.empty())
        report["heatMap"] = base64(heatMapPng);
    constexpr std::string_view place = R"(id="report">)";
    constexpr std::string_view page = profile_page::profileHtml;
    constexpr std::size_t begin = page.find(place) + place.size();
    std::string html(page.substr(0, begin));
    // A "<", which only strings have, could end the element.
    for (const char letter : jsonText(report))
        html += letter == '<' ? "\\u003c" : std::string(1, letter);
    return html.append(page.substr(begin));
}

} // namespace hyalite::core
