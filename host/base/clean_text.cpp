#include "host/base/clean_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyalite::core {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD"; // U+FFFD

/// Replaces invalid UTF-8 with the JSON library, which also writes reports.
std::string validUtf8(std::string_view text) {
    using Json = nlohmann::json;
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

/// Length in bytes of the first character of valid UTF-8 if it must not be shown; else 0.
std::size_t hiddenBytes(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if ((byte(0) < 0x20 && byte(0) != '\n') || byte(0) == 0x7F)
        return 1;
    if (byte(0) == 0xC2)
        return byte(1) < 0xA0 ? 2 : 0; // U+0080 to U+009F
    if (byte(0) == 0xD8)
        return byte(1) == 0x9C ? 2 : 0; // U+061C
    if (byte(0) == 0xEF)
        return byte(1) == 0xBF && byte(2) >= 0xBE ? 3 : 0; // U+FFFE, U+FFFF
    if (byte(0) != 0xE2)
        return 0;
    const bool isMark = byte(1) == 0x80 && (byte(2) == 0x8E || byte(2) == 0x8F); // U+200E, U+200F
    // U+2028 to U+202E.
    const bool isSeparatorOrEmbedding = byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE;
    const bool isIsolate = byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9; // U+2066 to U+2069
    return isMark || isSeparatorOrEmbedding || isIsolate ? 3 : 0;
}

} // namespace

std::string cleanText(std::string_view text) {
    const std::string valid = validUtf8(text);
    std::string clean;
    clean.reserve(valid.size());
    for (std::size_t i = 0; i < valid.size();) {
        const std::size_t hidden = hiddenBytes(std::string_view(valid).substr(i));
        if (hidden > 0)
            clean += replacement;
        else
            clean += valid[i];
        i += hidden > 0 ? hidden : 1;
    }
    return clean;
}

std::string excerpt(std::string_view text, std::size_t maxBytes) {
    std::size_t end = std::min(text.size(), maxBytes);
    while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
        --end; // never inside a UTF-8 sequence
    std::string line;
    for (const char c : cleanText(text.substr(0, end)))
        line += c == '\n' ? std::string(replacement) : std::string(1, c);
    return end < text.size() ? line + "..." : line;
}

std::string refusalText(std::string_view found, std::string_view allowed) {
    return fmt::format("found \"{}\"; allowed: {}", excerpt(found), allowed);
}

} // namespace hyalite::core
