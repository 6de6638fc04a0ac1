#include "host/scene/mtl.h"

#include "host/scene/limits.h"
#include "host/scene/obj_lines.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace hyalite {

namespace {

/// What the statements of one material say.
struct MtlStatements {
    std::string name;
    glm::vec3 diffuse{0.8f};
    glm::vec3 specular{0.0f};
    glm::vec3 emission{0.0f};
    std::optional<float> exponent;
    std::optional<float> roughness;
    float metallic = 0.0f;
    float opacity = 1.0f;
    float index = 1.5f;
    int illumination = 2;
};

float fraction(float value) { return std::clamp(value, 0.0f, 1.0f); }

glm::vec3 fraction(const glm::vec3 &colour) {
    return {fraction(colour.x), fraction(colour.y), fraction(colour.z)};
}

float mean(const glm::vec3 &colour) { return (colour.x + colour.y + colour.z) / 3.0f; }

/// The roughness whose microfacets are spread as Blinn and Phong's with this exponent: Walter et al., "Microfacet Models for
/// Refraction through Rough Surfaces", EGSR 2007, section 5.2.
float roughnessOf(float exponent) { return std::sqrt(std::sqrt(2.0f / (std::max(exponent, 0.0f) + 2.0f))); }

Material materialOf(const MtlStatements &mtl) {
    Material material;
    material.name = mtl.name;
    material.twoSided = true;
    const bool isMetal = mtl.illumination == 3 || mtl.illumination == 5;
    const bool isGlass =
        mtl.illumination == 4 || mtl.illumination == 6 || mtl.illumination == 7 || mtl.illumination == 9;
    if (isGlass) {
        material.kind = MaterialKind::Dielectric;
        material.refractiveIndex = mtl.index;
        return material;
    }
    material.albedo = isMetal ? mtl.specular : mtl.diffuse;
    material.emission = mtl.emission;
    const bool isMatt = !isMetal && !mtl.roughness && mtl.specular == glm::vec3(0.0f) &&
                        mtl.metallic == 0.0f && mtl.opacity == 1.0f;
    if (isMatt)
        return material;
    material.kind = MaterialKind::Principled;
    material.refractiveIndex = mtl.index;
    material.roughness = mtl.roughness ? *mtl.roughness : roughnessOf(mtl.exponent.value_or(0.0f));
    material.metallic = isMetal ? 1.0f : mtl.metallic;
    material.specular = mtl.roughness ? 0.5f : mean(mtl.specular);
    material.transmission = 1.0f - mtl.opacity;
    return material;
}

/// The words of a line.
class Words {
  public:
    Words(std::string_view line, const ObjLines &lines) : rest_(line), lines_(lines) {}

    /// Empty at the end of the line, and where a comment begins.
    [[nodiscard]] std::string_view next() {
        const std::size_t begin = std::min(rest_.find_first_not_of(" \t"), rest_.size());
        rest_.remove_prefix(begin);
        if (rest_.starts_with('#'))
            rest_ = {};
        const std::size_t length = std::min(rest_.find_first_of(" \t"), rest_.size());
        const std::string_view word = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return word;
    }

    /// All that is left, without blanks around it.
    [[nodiscard]] std::string_view remainder() {
        const std::size_t begin = std::min(rest_.find_first_not_of(" \t"), rest_.size());
        const std::size_t end = rest_.find_last_not_of(" \t") + 1;
        return begin < end ? rest_.substr(begin, end - begin) : std::string_view();
    }

    [[nodiscard]] float number(std::string_view keyword) { return parse(keyword, next()); }

    /// One number stands for three.
    [[nodiscard]] glm::vec3 colour(std::string_view keyword) {
        const float red = number(keyword);
        const std::string_view second = next();
        if (second.empty())
            return glm::vec3(red);
        const float green = parse(keyword, second);
        return {red, green, number(keyword)};
    }

  private:
    [[nodiscard]] float parse(std::string_view keyword, std::string_view word) const {
        std::string_view digits = word;
        if (digits.starts_with('+'))
            digits.remove_prefix(1);
        float value = 0.0f;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
            lines_.fail(fmt::format("{} has {}; allowed are finite decimal numbers", keyword,
                                    word.empty() ? "fewer numbers than it needs" : quoteInput(word)));
        return value;
    }

    std::string_view rest_;
    const ObjLines &lines_;
};

/// Takes what a statement says; whatever it does not know says nothing.
void take(MtlStatements &mtl, std::string_view keyword, Words &words) {
    if (keyword == "Kd")
        mtl.diffuse = fraction(words.colour(keyword));
    else if (keyword == "Ks")
        mtl.specular = fraction(words.colour(keyword));
    else if (keyword == "Ke")
        mtl.emission = glm::max(words.colour(keyword), glm::vec3(0.0f));
    else if (keyword == "Ns")
        mtl.exponent = words.number(keyword);
    else if (keyword == "Pr")
        mtl.roughness = fraction(words.number(keyword));
    else if (keyword == "Pm")
        mtl.metallic = fraction(words.number(keyword));
    else if (keyword == "d")
        mtl.opacity = fraction(words.number(keyword));
    else if (keyword == "Tr")
        mtl.opacity = 1.0f - fraction(words.number(keyword));
    else if (keyword == "Ni")
        mtl.index = std::clamp(words.number(keyword), 1.0f, 10.0f);
    else if (keyword == "illum")
        mtl.illumination = static_cast<int>(std::clamp(words.number(keyword), 0.0f, 10.0f));
}

bool knows(std::string_view keyword) {
    constexpr std::string_view keywords[] = {"Kd", "Ks", "Ke", "Ns", "Pr", "Pm", "d", "Tr", "Ni", "illum"};
    return std::find(std::begin(keywords), std::end(keywords), keyword) != std::end(keywords);
}

} // namespace

std::vector<Material> loadMtl(const std::filesystem::path &file) {
    ObjLines lines(file);
    std::vector<Material> materials;
    std::unordered_set<std::string> names;
    std::optional<MtlStatements> current;
    const auto finish = [&] {
        if (current && names.insert(current->name).second)
            materials.push_back(materialOf(*current));
        if (materials.size() > limits::materialCount)
            lines.fail(fmt::format("there are more than {} materials", limits::materialCount));
    };
    while (const std::optional<std::span<char>> line = lines.next()) {
        Words words({line->data(), line->size()}, lines);
        const std::string_view keyword = words.next();
        if (keyword == "newmtl") {
            finish();
            current.emplace();
            current->name = std::string(words.remainder());
        } else if (knows(keyword)) {
            if (!current)
                lines.fail(fmt::format("{} stands before the first newmtl", keyword));
            take(*current, keyword, words);
        }
    }
    finish();
    return materials;
}

} // namespace hyalite
