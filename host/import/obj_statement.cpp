#include "host/import/obj_statement.h"

#include "host/base/letter_case.h"
#include "host/image/tone_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace hyalite::core {

namespace {

// Every scan stops at an unexpected character; the zero after a text and the line feed after a statement are two.
bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isDigit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
bool endsToken(char c) { return isBlank(c) || c == '\n' || c == '\r'; }
bool endsStatement(char c) { return c == '\n' || c == '#'; } // where a token would begin

template <class Char> Char *skipBlanks(Char *at) {
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

/// The position after the LF or CRLF at `at`.
const char *skipLineEnd(const char *at) {
    if (*at == '\r')
        ++at;
    return *at == '\n' ? at + 1 : nullptr;
}

/// The position after the line end, which may follow ignored text.
const char *skipToNextLine(const char *at) {
    while ((*at >= ' ' && *at != '\\') || *at == '\t')
        ++at;
    return skipLineEnd(at);
}

// ---- Tokens

/// Reads the exponent after the e of a number, whose digits before it are `sum`.
const char *readExponent(const char *at, double &sum) {
    const bool isNegative = *at == '-';
    if (isNegative || *at == '+')
        ++at;
    const char *const digits = at;
    int exponent = 0;
    for (; isDigit(*at) && at - digits < 4; ++at)
        exponent = exponent * 10 + (*at - '0');
    if (at == digits || at - digits > 3)
        return nullptr;
    if (isNegative)
        exponent = -exponent;
    if (exponent != 0)
        sum = std::ldexp(sum * std::pow(5.0, exponent), exponent);
    return at;
}

/// Reads a number after blanks: [-] digits [. digits] [e [sign] 1 to 3 digits], at most 128 characters. Returns the
/// position after it, or null. Adds up the digits as tinyobjloader does, to the same bits: std::from_chars gives other
/// last bits, which show in meshes far from zero. Digits are at least 1e-127 or all zero, so that the power of an
/// exponent neither overflows nor loses them.
const char *readNumber(const char *at, double &value) {
    constexpr std::ptrdiff_t maxCharacters = 128;
    constexpr std::array<double, 8> powersOfTen{1.0, 0.1, 0.01, 0.001, 0.0001, 0.00001, 0.000001, 0.0000001};
    at = skipBlanks(at);
    const char *const begin = at;
    if (*at == '-')
        ++at;
    const char *const digits = at;
    double sum = 0.0;
    for (; isDigit(*at); ++at)
        sum = sum * 10.0 + (*at - '0');
    std::ptrdiff_t digitCount = at - digits;
    if (*at == '.') {
        const char *const point = at++;
        for (; isDigit(*at); ++at) {
            const auto place = static_cast<std::size_t>(at - point);
            sum += (*at - '0') * (place < powersOfTen.size() ? powersOfTen[place]
                                                             : std::pow(10.0, -static_cast<double>(place)));
        }
        digitCount += at - point - 1;
    }
    if (*at == 'e' || *at == 'E') {
        at = readExponent(at + 1, sum);
        if (!at)
            return nullptr;
    }
    value = *begin == '-' ? -sum : sum;
    return digitCount > 0 && endsToken(*at) && at - begin <= maxCharacters ? at : nullptr;
}

/// Whether the token is a non-finite number as printf writes it: nan, -nan, inf, infinity, nan(...), or 1.#QNAN,
/// -1.#IND, 1.#INF of old libraries.
bool isNotFinite(std::string_view token) {
    if (token.starts_with('+') || token.starts_with('-'))
        token.remove_prefix(1);
    const std::string head = lowerCase(token.substr(0, 3));
    return head == "nan" || head == "inf" || head == "1.#";
}

/// Reads an index of 32 bits with an optional sign. Returns the position after it, or null.
const char *readAnyIndex(const char *at, std::int32_t &index) {
    constexpr std::uint64_t limit = std::uint64_t{1} << 31;
    const bool isNegative = *at == '-';
    if (isNegative || *at == '+')
        ++at;
    const char *const digits = at;
    std::uint64_t value = 0;
    for (; isDigit(*at); ++at)
        value = std::min(value * 10 + static_cast<std::uint64_t>(*at - '0'), 2 * limit); // of any length
    index = static_cast<std::int32_t>(isNegative ? -value : value);
    return at != digits && value < limit + isNegative ? at : nullptr;
}

/// The same, quickly for one to nine digits without a sign, as nearly all are.
inline const char *readIndex(const char *at, std::int32_t &index) {
    const char *const digits = at;
    std::uint32_t value = 0;
    for (; isDigit(*at); ++at)
        value = value * 10 + static_cast<std::uint32_t>(*at - '0');
    if (at == digits || at - digits > 9)
        return readAnyIndex(digits, index);
    index = static_cast<std::int32_t>(value);
    return at;
}

/// Reads a corner: v, v/vt, v//vn or v/vt/vn, or v/, v// and v/vt/ as some programs write them. Only vt may be 0.
/// Returns the position after the token, or null.
inline const char *readCorner(const char *at, FaceCorner &corner) {
    corner = {};
    at = readIndex(at, corner.position);
    if (!at || corner.position == 0)
        return nullptr;
    if (*at == '/' && !endsToken(*++at)) {
        if (*at != '/')
            at = readIndex(at, corner.uv);
        if (at && *at == '/' && !endsToken(*++at)) {
            at = readIndex(at, corner.normal);
            if (corner.normal == 0)
                return nullptr;
        }
    }
    return at && endsToken(*at) ? at : nullptr;
}

/// Reads corners up to the first token that is none, of which there are at most 8. Returns that token's position.
const char *readCorners(const char *at, std::array<FaceCorner, 8> &corners, std::size_t &count) {
    at = skipBlanks(at);
    for (count = 0; count < corners.size() && !endsToken(*at); ++count) {
        const char *const behind = readCorner(at, corners[count]);
        if (!behind)
            break;
        at = skipBlanks(behind);
    }
    return at;
}

/// The colour behind the coordinates of a v, which begins at `at` and ends before the line end: three numbers, or the
/// weight and three numbers. As in files of Blender and MeshLab they are sRGB in [0, 1]; the result is linear. Empty
/// for anything else.
std::optional<glm::vec3> readVertexColour(const char *at) {
    std::array<double, 4> values{};
    std::size_t count = 0;
    while (count < values.size() && (at = readNumber(at, values[count])))
        ++count;
    if (count < 3)
        return std::nullopt;
    const auto linear = [&](std::size_t channel) {
        const double value = values[count - 3 + channel];
        return value > 0.0 ? static_cast<float>(srgbDecoded(std::min(value, 1.0))) : 0.0f; // NaN is 0, too
    };
    return glm::vec3(linear(0), linear(1), linear(2));
}

// ---- Statements for tinyobjloader

/// Checks the `count` numbers of a v, vn or vt. Returns where they end, or null if one of them is not finite.
char *checkNumbers(std::string_view keyword, char *at, int count, const ObjLines &lines) {
    bool isFinite = true;
    for (int i = 0; i < count; ++i) {
        char *const begin = skipBlanks(at);
        if (i > 0 && keyword == "vt" && endsStatement(*begin))
            break;
        if (endsStatement(*begin))
            lines.fail(std::string(keyword) +
                       (keyword == "vt" ? " has no number" : " has fewer than three numbers"));
        const std::string_view token = tokenAt(begin);
        double value = 0.0;
        const char *const digits = *begin == '+' && begin[1] != '-' ? begin + 1 : begin;
        const bool isNumber = readNumber(digits, value) == begin + token.size();
        if (!isNumber && !isNotFinite(token))
            lines.fail(std::string(keyword) + " has " + quoteInput(token) +
                       "; allowed are finite decimal numbers of up to 128 characters, such as -1.5e-3");
        isFinite = isFinite && isNumber;
        at = begin + token.size();
    }
    return isFinite ? at : nullptr;
}

/// Returns where the corners end, or null if they are fewer than three.
char *checkFace(char *arguments, const ObjLines &lines) {
    std::array<FaceCorner, 8> corners;
    std::size_t count = corners.size();
    std::size_t cornerCount = 0;
    const char *at = arguments;
    for (; count == corners.size(); cornerCount += count)
        at = readCorners(at, corners, count);
    if (!endsStatement(*at))
        lines.fail("the face's corner " + quoteInput(tokenAt(at)) +
                   " is none of v, v/vt, v//vn, v/vt/vn with indices in [-2147483648, 2147483647], not 0");
    if (cornerCount > maxFaceCorners)
        lines.fail("the face has " + std::to_string(cornerCount) + " corners; allowed are 3 to " +
                   std::to_string(maxFaceCorners));
    char *const behind = arguments + (at - arguments);
    for (char *slash = behind; slash-- != arguments;)
        if (*slash == '/' && endsToken(slash[1]))
            *slash = ' ';
    return cornerCount < 3 ? nullptr : behind;
}

void leaveOut(std::string_view keyword, const ObjLines &lines, MeshBuilder &builder) {
    ++builder.report().unusedStatementCount;
    const bool isDrawing = keyword == "l" || keyword == "p";
    builder.losses().add(isDrawing ? keyword : "unused", [&] {
        return fmt::format("{}:{}: {} left out: {}", lines.fileName(), lines.lineNumber(),
                           isDrawing ? keyword == "l" ? "a line is" : "points are"
                                     : quoteInput(keyword) + " is",
                           isDrawing ? "surfaces are rendered" : "it is no statement that is read");
    });
}

} // namespace

const char *readPlainStatement(const char *line, std::size_t lineNumber, MeshBuilder &builder) {
    if (line[0] == 'f' && isBlank(line[1])) {
        std::array<FaceCorner, 8> corners;
        std::size_t count = 0;
        const char *const nextBegin = skipLineEnd(readCorners(line + 2, corners, count));
        if (!nextBegin || count < 3)
            return nullptr;
        builder.addFace(std::span(corners).first(count), lineNumber);
        return nextBegin;
    }
    if (line[0] != 'v')
        return nullptr;
    const bool isNormal = line[1] == 'n';
    const bool isUv = line[1] == 't';
    const char *at = line + (isNormal || isUv ? 2 : 1);
    if (!isBlank(*at))
        return nullptr;
    glm::dvec3 values;
    for (int i = 0; i < (isUv ? 2 : 3); ++i) {
        at = readNumber(at, values[i]);
        if (!at)
            return nullptr;
    }
    const char *const nextBegin = skipToNextLine(at);
    if (!nextBegin)
        return nullptr;
    if (isNormal)
        builder.addNormal(values);
    else if (isUv)
        builder.addUv(glm::dvec2(values));
    else {
        builder.addPosition(values, lineNumber);
        if (const std::optional<glm::vec3> colour = readVertexColour(at))
            builder.setColour(*colour);
    }
    return nextBegin;
}

CheckedStatement checkStatement(std::span<char> statement, const ObjLines &lines, MeshBuilder &builder) {
    statement.data()[statement.size()] = '\n';
    char *const begin = skipBlanks(statement.data());
    if (endsStatement(*begin))
        return {};
    const std::string_view keyword = tokenAt(begin);
    char *const arguments = begin + keyword.size();
    char *behind = nullptr;
    std::optional<glm::vec3> colour;
    if (keyword == "v") {
        behind = checkNumbers(keyword, arguments, 3, lines);
        if (behind)
            colour = readVertexColour(behind);
        else
            builder.addPosition(glm::dvec3(std::numeric_limits<double>::quiet_NaN()), lines.lineNumber());
    } else if (keyword == "vn") {
        behind = checkNumbers(keyword, arguments, 3, lines);
        if (!behind)
            builder.addNormal(glm::dvec3(0.0));
    } else if (keyword == "vt") {
        behind = checkNumbers(keyword, arguments, 2, lines);
        if (!behind)
            builder.addUv(glm::dvec2(0.0));
    } else if (keyword == "f") {
        behind = checkFace(arguments, lines);
        if (!behind)
            builder.addFace({}, lines.lineNumber());
    } else {
        constexpr std::array<std::string_view, 10> ignored{"g",   "o",        "s",        "mg",    "usemtl",
                                                           "lod", "c_interp", "d_interp", "bevel", "mtllib"};
        if (std::ranges::find(ignored, keyword) == ignored.end())
            leaveOut(keyword, lines, builder);
    }
    if (!behind)
        return {};
    *behind = '\n';
    return {{begin, behind + 1}, colour};
}

} // namespace hyalite::core
