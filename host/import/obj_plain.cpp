#include "host/import/obj_plain.h"

#include "host/image/tone_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace hyalite {

namespace {

// Every scan stops at an unexpected character; the zero after the last character is one.
bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isDigit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
bool endsToken(char c) { return isBlank(c) || c == '\n' || c == '\r'; }

const char *skipBlanks(const char *at) {
    while (isBlank(*at))
        ++at;
    return at;
}

// The position after the LF or CRLF at `at`.
const char *skipLineEnd(const char *at) {
    if (*at == '\r')
        ++at;
    return *at == '\n' ? at + 1 : nullptr;
}

// The position after the line end, which may follow ignored text.
const char *skipToNextLine(const char *at) {
    while ((*at >= ' ' && *at != '\\') || *at == '\t')
        ++at;
    return skipLineEnd(at);
}

// Reads the exponent after the e of a number, whose digits before it are `sum`.
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

// Reads a number after blanks: [-] digits [. digits] [e [sign] 1 to 3 digits], at most 128 characters. Returns the
// position after it. Adds up the digits as tinyobjloader does, to the same bits.
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

// Reads `count` numbers and returns the position after them.
const char *readNumbers(const char *at, int count, glm::dvec3 &values) {
    for (int i = 0; i < count && at; ++i)
        at = readNumber(at, values[i]);
    return at;
}

// Reads an index of up to nine digits, which fit any int, with an optional minus sign; not 0.
const char *readIndex(const char *at, std::int32_t &index) {
    const bool isNegative = *at == '-';
    if (isNegative)
        ++at;
    const char *const digits = at;
    std::uint32_t value = 0;
    for (; isDigit(*at); ++at)
        value = value * 10 + static_cast<std::uint32_t>(*at - '0');
    if (at - digits > 9 || value == 0) // without digits the value is 0, too
        return nullptr;
    index = isNegative ? -static_cast<std::int32_t>(value) : static_cast<std::int32_t>(value);
    return at;
}

// Reads a corner: v, v/vt, v//vn or v/vt/vn.
const char *readCorner(const char *at, FaceCorner &corner) {
    corner.normal = 0;
    corner.uv = 0;
    at = readIndex(at, corner.position);
    if (!at || *at != '/')
        return at;
    ++at;
    if (*at != '/') {
        at = readIndex(at, corner.uv);
        if (!at || *at != '/')
            return at;
    }
    return readIndex(at + 1, corner.normal);
}

const char *readFace(const char *at, std::size_t lineNumber, MeshBuilder &builder) {
    std::array<FaceCorner, 8> corners;
    std::size_t count = 0;
    for (at = skipBlanks(at); count < corners.size() && *at >= '-'; at = skipBlanks(at)) {
        at = readCorner(at, corners[count++]);
        if (!at || !endsToken(*at))
            return nullptr;
    }
    at = skipLineEnd(at);
    if (at && count >= 3)
        builder.addFace(std::span(corners).first(count), lineNumber);
    return count >= 3 ? at : nullptr;
}

} // namespace

const char *readPlainStatement(const char *line, std::size_t lineNumber, MeshBuilder &builder) {
    if (line[0] == 'f' && isBlank(line[1]))
        return readFace(line + 2, lineNumber, builder);
    if (line[0] != 'v')
        return nullptr;
    const bool isNormal = line[1] == 'n';
    const bool isUv = line[1] == 't';
    const char *at = line + (isNormal || isUv ? 2 : 1);
    glm::dvec3 values;
    if (!isBlank(*at))
        return nullptr;
    const char *const behind = readNumbers(at, isUv ? 2 : 3, values);
    at = behind ? skipToNextLine(behind) : nullptr;
    if (!at)
        return nullptr;
    if (isNormal)
        builder.addNormal(values);
    else if (isUv)
        builder.addUv(glm::dvec2(values));
    else {
        builder.addPosition(values, lineNumber);
        if (const std::optional<glm::vec3> colour = readVertexColour(behind))
            builder.setColour(*colour);
    }
    return at;
}

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

} // namespace hyalite
