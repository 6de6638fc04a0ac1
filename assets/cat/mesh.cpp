#include "assets/cat/mesh.h"

#include <cassert>
#include <charconv>
#include <string_view>

namespace hyalite::cat {
namespace {

constexpr int decimalCount = 5;
constexpr double halfLastDecimal = 0.5e-5;

void appendNumber(std::string &text, double value) {
    // What would print as -0.00000 is written without its sign.
    const double printed = std::abs(value) < halfLastDecimal ? 0.0 : value;
    std::array<char, 64> digits;
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), printed,
                                      std::chars_format::fixed, decimalCount);
    assert(result.ec == std::errc());
    text.append(digits.data(), result.ptr);
}

void appendIndex(std::string &text, std::uint32_t value) {
    std::array<char, 16> digits;
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    assert(result.ec == std::errc());
    text.append(digits.data(), result.ptr);
}

void appendVector(std::string &text, std::string_view keyword, const Vec3 &v) {
    text += keyword;
    for (const double component : {v.x, v.y, v.z}) {
        text += ' ';
        appendNumber(text, component);
    }
    text += '\n';
}

} // namespace

std::string formatObj(const Mesh &mesh, const std::string &comment) {
    assert(mesh.positions.size() == mesh.normals.size());
    std::string text;
    text.reserve(mesh.positions.size() * 60 + mesh.triangles.size() * 44 + comment.size() + 16);
    text += "# " + comment + '\n';
    for (const Vec3 &position : mesh.positions)
        appendVector(text, "v", position);
    for (const Vec3 &normal : mesh.normals)
        appendVector(text, "vn", normal);
    for (const auto &triangle : mesh.triangles) {
        text += 'f';
        for (const std::uint32_t index : triangle) {
            text += ' ';
            appendIndex(text, index + 1);
            text += "//";
            appendIndex(text, index + 1);
        }
        text += '\n';
    }
    return text;
}

} // namespace hyalite::cat
