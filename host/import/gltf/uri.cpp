#include "host/import/gltf/uri.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string_view>

namespace hyalite::core::gltf {
namespace {

constexpr std::uint8_t notBase64 = 255;

constexpr std::array<std::uint8_t, 256> base64Values = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(notBase64);
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < letters.size(); ++i)
        values[static_cast<unsigned char>(letters[i])] = static_cast<std::uint8_t>(i);
    return values;
}();

std::vector<std::byte> decodeBase64(std::string_view text, const JsonNode &uri) {
    while (text.ends_with('='))
        text.remove_suffix(1);
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int bitCount = 0;
    for (const char letter : text) {
        const std::uint8_t value = base64Values[static_cast<unsigned char>(letter)];
        if (value == notBase64)
            uri.fail("its data is not base64");
        bits = bits << 6 | value;
        bitCount += 6;
        if (bitCount >= 8) {
            bitCount -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> bitCount & 255u));
        }
    }
    return bytes;
}

int hexOf(char digit) {
    const int lower = std::tolower(static_cast<unsigned char>(digit));
    return lower >= '0' && lower <= '9' ? lower - '0' : lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

} // namespace

std::optional<std::vector<std::byte>> dataOf(const JsonNode &uri) {
    const std::string text = uri.text();
    if (!text.starts_with("data:"))
        return std::nullopt;
    constexpr std::string_view marker = ";base64,";
    const std::size_t comma = text.find(',');
    const std::size_t begin = comma == std::string::npos ? comma : comma + 1;
    if (begin == std::string::npos || begin < marker.size() ||
        std::string_view(text).substr(begin - marker.size(), marker.size()) != marker)
        uri.fail("found data that is not in base64; allowed: data:TYPE;base64,...");
    return decodeBase64(std::string_view(text).substr(begin), uri);
}

std::string fileNameOf(const JsonNode &uri) {
    const std::string text = uri.text();
    if (text.find("://") != std::string::npos || text.starts_with("file:"))
        uri.refuse("the name of a file beside this one, or data:");
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool isEscape =
            text[i] == '%' && i + 2 < text.size() && hexOf(text[i + 1]) >= 0 && hexOf(text[i + 2]) >= 0;
        name += isEscape ? static_cast<char>(16 * hexOf(text[i + 1]) + hexOf(text[i + 2])) : text[i];
        i += isEscape ? 2 : 0;
    }
    if (name.find('\0') != std::string::npos)
        uri.refuse("a name without the character NUL");
    return name;
}

} // namespace hyalite::core::gltf
