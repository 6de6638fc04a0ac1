#include "host/report/clean_text.h"

#include <nlohmann/json.hpp>

namespace hyalite {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD"; // U+FFFD

/// What is not UTF-8 is replaced by the library that also writes it into reports.
std::string validUtf8(std::string_view text) {
    using Json = nlohmann::json;
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

} // namespace

std::string cleanText(std::string_view text) {
    const std::string valid = validUtf8(text);
    std::string clean;
    clean.reserve(valid.size());
    for (std::size_t i = 0; i < valid.size(); ++i) {
        const auto byte = static_cast<unsigned char>(valid[i]);
        const bool isC1 = byte == 0xC2 && static_cast<unsigned char>(valid[i + 1]) < 0xA0; // U+0080 to U+009F
        if (isC1)
            ++i;
        if (isC1 || (byte < 0x20 && byte != '\n') || byte == 0x7F)
            clean += replacement;
        else
            clean += valid[i];
    }
    return clean;
}

} // namespace hyalite
