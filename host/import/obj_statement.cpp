#include "host/import/obj_statement.h"

#include "host/base/letter_case.h"
#include "host/import/obj_plain.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace hyalite {

namespace {

// Every scan below stops at the line feed that ends the statement, without asking for the end.
bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool endsToken(char c) { return isBlank(c) || c == '\n'; }
bool endsStatement(char c) { return c == '\n' || c == '#'; } // where a token would begin

char *skipBlanks(char *at) {
    while (isBlank(*at))
        ++at;
    return at;
}

std::string_view tokenAt(const char *begin) {
    const char *end = begin;
    while (!endsToken(*end))
        ++end;
    return {begin, end};
}

// Scans a number: [sign] digits [. digits] [e [sign] 1 to 3 digits], at most 128 characters. Its digits are then at
// least 1e-127 or all zero, and digits * 5^exponent * 2^exponent in tinyobjloader neither overflows an int nor loses
// the digits before the exponent restores them. Returns null unless the whole token is such a number.
char *scanNumber(char *begin) {
    constexpr std::ptrdiff_t maxCharacters = 128;
    char *at = begin;
    if (*at == '+' || *at == '-')
        ++at;
    const char *const digits = at;
    while (isDigit(*at))
        ++at;
    std::ptrdiff_t digitCount = at - digits;
    if (*at == '.') {
        const char *const decimals = ++at;
        while (isDigit(*at))
            ++at;
        digitCount += at - decimals;
    }
    if (digitCount == 0)
        return nullptr;
    if (*at == 'e' || *at == 'E') {
        ++at;
        if (*at == '+' || *at == '-')
            ++at;
        const char *const exponent = at;
        while (isDigit(*at))
            ++at;
        if (at == exponent || at - exponent > 3)
            return nullptr;
    }
    return endsToken(*at) && at - begin <= maxCharacters ? at : nullptr;
}

// Whether the token is a non-finite number as printf writes it: nan, -nan, inf, infinity, nan(...), or 1.#QNAN,
// -1.#IND, 1.#INF of old libraries.
bool isNotFinite(std::string_view token) {
    if (token.starts_with('+') || token.starts_with('-'))
        token.remove_prefix(1);
    if (token.starts_with("1.#"))
        return true;
    if (token.size() < 3)
        return false;
    const std::string head = lowerCase(token.substr(0, 3));
    return head == "nan" || head == "inf";
}

[[noreturn]] void failNumber(const char *keyword, const char *at, const ObjLines &lines) {
    if (endsStatement(*at))
        lines.fail(std::string(keyword) +
                   (std::string_view(keyword) == "vt" ? " has no number" : " has fewer than three numbers"));
    lines.fail(std::string(keyword) + " has " + quoteInput(tokenAt(at)) +
               "; allowed are finite decimal numbers of up to 128 characters, such as -1.5e-3");
}

/// `isLost` becomes whether a number is not finite.
std::span<char> checkVertex(char *keyword, const ObjLines &lines, bool &isLost) {
    constexpr std::string_view zeroVertex = "v 0 0 0";
    char *at = keyword + 1;
    for (int i = 0; i < 3; ++i) {
        char *begin = skipBlanks(at);
        at = scanNumber(begin);
        if (!at && !isNotFinite(tokenAt(begin)))
            failNumber("v", begin, lines);
        isLost = isLost || !at;
        if (!at)
            at = begin + tokenAt(begin).size();
    }
    if (isLost)
        at = std::copy(zeroVertex.begin(), zeroVertex.end(), keyword); // the shortest v of three tokens
    return {keyword, at};
}

std::span<char> checkNormal(char *keyword, const ObjLines &lines) {
    constexpr std::string_view zeroNormal = "vn 0 0 0";
    bool isFinite = true;
    char *at = keyword + 2;
    for (int i = 0; i < 3; ++i) {
        char *begin = skipBlanks(at);
        at = scanNumber(begin);
        if (!at && !isNotFinite(tokenAt(begin)))
            failNumber("vn", begin, lines);
        isFinite = isFinite && at;
        if (!at)
            at = begin + tokenAt(begin).size();
    }
    if (!isFinite)
        at = std::copy(zeroNormal.begin(), zeroNormal.end(), keyword); // the shortest vn of three tokens
    return {keyword, at};
}

std::span<char> checkUv(char *keyword, const ObjLines &lines) {
    constexpr std::string_view zeroUv = "vt 0 0";
    bool isFinite = true;
    char *at = keyword + 2;
    for (int i = 0; i < 2; ++i) {
        char *begin = skipBlanks(at);
        if (i > 0 && endsStatement(*begin))
            break;
        at = scanNumber(begin);
        if (!at && !isNotFinite(tokenAt(begin)))
            failNumber("vt", begin, lines);
        isFinite = isFinite && at;
        if (!at)
            at = begin + tokenAt(begin).size();
    }
    if (!isFinite)
        at = std::copy(zeroUv.begin(), zeroUv.end(), keyword); // as short as "vt nan"
    return {keyword, at};
}

// Scans an index: digits with an optional sign that fit 32 bits; 0 only if `zeroAllowed`. Returns null otherwise.
char *scanIndex(char *at, bool zeroAllowed) {
    constexpr std::int64_t limit = std::int64_t{1} << 31;
    const bool isNegative = *at == '-';
    if (isNegative || *at == '+')
        ++at;
    const char *const digits = at;
    std::int64_t value = 0;
    for (; isDigit(*at); ++at)
        value = std::min(value * 10 + (*at - '0'), limit + 1);
    const bool fits = value <= (isNegative ? limit : limit - 1);
    return at != digits && fits && (zeroAllowed || value != 0) ? at : nullptr;
}

// Scans a corner: v, v/vt, v//vn or v/vt/vn, or v/, v// and v/vt/ as some programs write them. Returns null otherwise.
char *scanCorner(char *at) {
    at = scanIndex(at, false);
    if (!at || *at != '/')
        return at;
    char *slash = at++;
    if (!endsToken(*at) && *at != '/') {
        at = scanIndex(at, true);
        if (!at || *at != '/')
            return at;
        slash = at;
    }
    if (*at == '/') {
        ++at;
        if (!endsToken(*at))
            return scanIndex(at, false);
    }
    std::fill(slash, at, ' ');
    return at;
}

/// Empty: of fewer than three corners.
std::span<char> checkFace(char *keyword, const ObjLines &lines) {
    std::size_t cornerCount = 0;
    char *at = skipBlanks(keyword + 1);
    for (; !endsStatement(*at); at = skipBlanks(at)) {
        char *begin = at;
        at = scanCorner(begin);
        if (!at || !endsToken(*at))
            lines.fail(
                "the face's corner " + quoteInput(tokenAt(begin)) +
                " is none of v, v/vt, v//vn, v/vt/vn with indices in [-2147483648, 2147483647], not 0");
        ++cornerCount;
    }
    if (cornerCount < 3)
        return {};
    if (cornerCount > maxFaceCorners)
        lines.fail("the face has " + std::to_string(cornerCount) + " corners; allowed are 3 to " +
                   std::to_string(maxFaceCorners));
    return {keyword, at};
}

} // namespace

CheckedStatement checkStatement(std::span<char> statement, const ObjLines &lines) {
    char *const end = statement.data() + statement.size();
    *end = '\n';
    char *const keyword = skipBlanks(statement.data());
    if (endsStatement(*keyword))
        return {ObjStatement::Skipped, {}};

    std::span<char> text;
    std::optional<glm::vec3> colour;
    bool isLost = false;
    if (keyword[0] == 'v' && endsToken(keyword[1])) {
        text = checkVertex(keyword, lines, isLost);
        if (!isLost)
            colour = readVertexColour(text.data() + text.size());
    } else if (keyword[0] == 'v' && keyword[1] == 'n' && endsToken(keyword[2]))
        text = checkNormal(keyword, lines);
    else if (keyword[0] == 'v' && keyword[1] == 't' && endsToken(keyword[2]))
        text = checkUv(keyword, lines);
    else if (keyword[0] == 'f' && endsToken(keyword[1])) {
        text = checkFace(keyword, lines);
        if (text.empty())
            return {ObjStatement::SmallFace, {}};
    }
    if (text.empty()) {
        constexpr std::array<std::string_view, 10> known{"g",   "o",        "s",        "mg",    "usemtl",
                                                         "lod", "c_interp", "d_interp", "bevel", "mtllib"};
        const bool isKnown = std::find(known.begin(), known.end(), tokenAt(keyword)) != known.end();
        return {isKnown ? ObjStatement::Skipped : ObjStatement::Unused, {}};
    }
    text.data()[text.size()] = '\n';
    return {ObjStatement::Geometry, std::span<char>(text.data(), text.size() + 1), colour, isLost};
}

} // namespace hyalite
