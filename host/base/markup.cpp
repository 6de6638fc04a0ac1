#include "host/base/markup.h"

#include "host/base/clean_text.h"

namespace hyalite::core {

std::string markupText(std::string_view text) {
    std::string escaped;
    for (const char letter : cleanText(text)) {
        switch (letter) {
        case '&':
            escaped += "&amp;";
            break;
        case '<':
            escaped += "&lt;";
            break;
        case '>':
            escaped += "&gt;";
            break;
        case '"':
            escaped += "&quot;";
            break;
        default:
            escaped += letter;
        }
    }
    return escaped;
}

} // namespace hyalite::core
