#include "host/import/mtl.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/image/texture_file.h"
#include "host/import/obj_lines.h"
#include "host/scene/limits.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>

namespace hyalite {

namespace {

/// The values of the statements of one material.
struct MtlStatements {
    std::string name;
    std::optional<glm::vec3> diffuse;
    glm::vec3 specular{0.0f};
    glm::vec3 emission{0.0f};
    std::optional<float> exponent;
    std::optional<float> roughness;
    float metallic = 0.0f;
    float opacity = 1.0f;
    float index = 1.5f;
    int illumination = 2;
    TextureSlots textures{};
    float normalStrength = 1.0f;
    std::string cutOutName; ///< of a map_Kd with transparent places; empty: it has none
};

float fraction(float value) { return std::clamp(value, 0.0f, 1.0f); }

glm::vec3 fraction(const glm::vec3 &colour) {
    return {fraction(colour.x), fraction(colour.y), fraction(colour.z)};
}

float mean(const glm::vec3 &colour) { return (colour.x + colour.y + colour.z) / 3.0f; }

/// The roughness whose microfacets spread like those of this Blinn-Phong exponent: Walter et al., "Microfacet Models
/// for Refraction through Rough Surfaces", EGSR 2007, section 5.2.
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
    const auto has = [&](std::uint32_t slot) { return mtl.textures[slot].has_value(); };
    const glm::vec3 diffuse = mtl.diffuse.value_or(glm::vec3(has(layout::slotBaseColour) ? 1.0f : 0.8f));
    material.albedo = isMetal ? mtl.specular : diffuse;
    const bool isDark = mtl.emission == glm::vec3(0.0f);
    material.emission = has(layout::slotEmission) && isDark ? glm::vec3(1.0f) : mtl.emission;
    material.textures = mtl.textures;
    material.normalStrength = mtl.normalStrength;
    const bool isMatt = !isMetal && !mtl.roughness && mtl.specular == glm::vec3(0.0f) &&
                        mtl.metallic == 0.0f && mtl.opacity == 1.0f && !has(layout::slotRoughness) &&
                        !has(layout::slotMetallic);
    if (isMatt)
        return material;
    material.kind = MaterialKind::Principled;
    material.refractiveIndex = mtl.index;
    const bool isPhysical = mtl.roughness || has(layout::slotRoughness) || has(layout::slotMetallic);
    material.roughness = has(layout::slotRoughness) ? 1.0f
                         : mtl.roughness            ? *mtl.roughness
                                                    : roughnessOf(mtl.exponent.value_or(0.0f));
    material.metallic = isMetal || has(layout::slotMetallic) ? 1.0f : mtl.metallic;
    material.specular = isPhysical ? 0.5f : mean(mtl.specular);
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

    /// The rest of the line, without blanks around it.
    [[nodiscard]] std::string_view remainder() {
        const std::size_t begin = std::min(rest_.find_first_not_of(" \t"), rest_.size());
        const std::size_t end = rest_.find_last_not_of(" \t") + 1;
        return begin < end ? rest_.substr(begin, end - begin) : std::string_view();
    }

    [[nodiscard]] float number(std::string_view keyword) { return parse(keyword, next()); }

    /// The next word if it is a number; otherwise empty, and the word is not consumed.
    [[nodiscard]] std::optional<float> tryNumber() {
        const std::string_view before = rest_;
        std::string_view digits = next();
        if (digits.starts_with('+'))
            digits.remove_prefix(1);
        float value = 0.0f;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (!digits.empty() && error == std::errc() && end == digits.data() + digits.size() &&
            std::isfinite(value))
            return value;
        rest_ = before;
        return std::nullopt;
    }

    /// Whether the next word is an option: a minus sign and letters.
    [[nodiscard]] bool isAtOption() const {
        const std::size_t begin = std::min(rest_.find_first_not_of(" \t"), rest_.size());
        const std::string_view rest = rest_.substr(begin);
        return rest.size() > 1 && rest[0] == '-' && rest[1] >= 'a' && rest[1] <= 'z';
    }

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

/// Texture statements and the slots that they fill.
struct TextureStatement {
    std::string_view keyword;
    std::optional<std::uint32_t> slot; ///< empty: ignored
};

constexpr TextureStatement textureStatements[] = {{"map_Kd", layout::slotBaseColour},
                                                  {"map_Ke", layout::slotEmission},
                                                  {"map_Pr", layout::slotRoughness},
                                                  {"map_Pm", layout::slotMetallic},
                                                  {"norm", layout::slotNormal},
                                                  {"map_Bump", layout::slotNormal},
                                                  {"map_bump", layout::slotNormal},
                                                  {"bump", layout::slotNormal},
                                                  {"map_d", layout::slotOpacity},
                                                  {"map_Ks", {}},
                                                  {"map_Ns", {}},
                                                  {"map_Ps", {}},
                                                  {"map_Tr", {}},
                                                  {"disp", {}},
                                                  {"decal", {}},
                                                  {"refl", {}}};

/// Reads the texture statements of one library.
class TextureReader {
  public:
    TextureReader(const std::filesystem::path &library, MtlTextures &textures, const ObjLines &lines)
        : base_(library.parent_path()), textures_(textures), lines_(lines) {}

    /// Returns whether `keyword` is a texture statement, and reads it if so.
    bool take(MtlStatements &mtl, std::string_view keyword, Words &words) {
        const auto *const statement =
            std::ranges::find(textureStatements, keyword, &TextureStatement::keyword);
        if (statement == std::end(textureStatements))
            return false;
        TextureUse use;
        float strength = 1.0f;
        const bool hasOptions = words.isAtOption();
        while (words.isAtOption())
            takeOption(words, use, strength);
        const std::string_view name = words.remainder();
        const auto isPlaced = [](const glm::vec2 &v) {
            return limits::texturePlacement.contains(v.x) && limits::texturePlacement.contains(v.y);
        };
        if (name.empty())
            lines_.fail(fmt::format("{} names no file", keyword));
        if (!isPlaced(use.scale) || !isPlaced(use.offset) || !limits::normalStrength.contains(strength))
            lines_.fail(fmt::format(
                "{} has a -s, -o or -bm out of range; allowed are {} for -s and -o, and {} for -bm", keyword,
                limits::texturePlacement.text(), limits::normalStrength.text()));
        if (!statement->slot)
            warn(fmt::format("{} {} is ignored; textures are read for {}", keyword, quoteInput(name),
                             "map_Kd, map_Ke, map_Pr, map_Pm, map_d, norm and map_Bump"));
        else if (const std::optional<std::uint32_t> index =
                     load(keyword, {name, hasOptions}, *statement->slot)) {
            use.textureIndex = *index;
            mtl.textures[*statement->slot] = use;
            if (*statement->slot == layout::slotNormal)
                mtl.normalStrength = strength;
            if (*statement->slot == layout::slotBaseColour)
                mtl.cutOutName = textures_.library.lookOf(*index).hasCutOuts ? std::string(name) : "";
        }
        return true;
    }

    /// Cuts out what is transparent in map_Kd, where there is no map_d. Call it when all of a material is read.
    void cutOut(MtlStatements &mtl) {
        if (mtl.cutOutName.empty() || mtl.textures[layout::slotOpacity])
            return;
        mtl.textures[layout::slotOpacity] = mtl.textures[layout::slotBaseColour];
        warn(fmt::format("the material {} is cut out where map_Kd {} is transparent, as there is no map_d",
                         quoteInput(mtl.name), quoteInput(mtl.cutOutName)));
    }

  private:
    void warn(const std::string &text) {
        constexpr std::size_t most = 32; // of all libraries of a mesh
        if (textures_.warnings.size() < most)
            textures_.warnings.push_back(
                fmt::format("{}:{}: {}", lines_.fileName(), lines_.lineNumber(), text));
        else if (textures_.warnings.size() == most)
            textures_.warnings.push_back(
                fmt::format("{}: further warnings are not shown", lines_.fileName()));
    }

    void takeOption(Words &words, TextureUse &use, float &strength) {
        const std::string_view option = words.next();
        if (option == "-bm") {
            strength = words.number(option);
            return;
        }
        const bool isScale = option == "-s";
        const bool isOffset = option == "-o";
        glm::vec2 &place = isScale ? use.scale : use.offset;
        int count = 0;
        for (; count < 3; ++count) {
            const std::optional<float> number = words.tryNumber();
            if (!number)
                break;
            if ((isScale || isOffset) && count < 2)
                place[count] = *number;
        }
        if ((isScale || isOffset) && count == 0)
            lines_.fail(fmt::format("{} has fewer numbers than it needs", option));
        if (isScale || isOffset)
            return;
        const bool hasWord = option == "-blendu" || option == "-blendv" || option == "-cc" ||
                             option == "-clamp" || option == "-imfchan" || option == "-type";
        const std::string_view value = hasWord ? words.next() : std::string_view();
        warn(fmt::format("the option {}{}{} is ignored; only -s, -o and -bm are read",
                         excerpt(option, maxExcerptBytes), hasWord ? " " : "",
                         excerpt(value, maxExcerptBytes)));
    }

    /// The end of a statement: a file's name, perhaps between what belongs to options.
    struct Name {
        std::string_view text;
        bool isAfterOptions;
    };

    /// The file of a name. Behind options that are not known, their words stand before it, and some programs write
    /// options after it.
    std::optional<std::filesystem::path> find(const Name &name) {
        std::optional<std::filesystem::path> file = textures_.files.find(base_, name.text);
        std::string_view rest = name.text;
        while (!file && name.isAfterOptions && rest.find(' ') != std::string_view::npos) {
            rest.remove_prefix(rest.find(' ') + 1);
            file = textures_.files.find(base_, rest);
        }
        if (const std::size_t options = name.text.find(" -");
            !file && options != std::string_view::npos && options > 0) {
            file = textures_.files.find(base_, name.text.substr(0, options));
            if (file)
                warn(fmt::format("{} is ignored; options stand before the name",
                                 quoteInput(name.text.substr(options + 1))));
        }
        return file;
    }

    std::optional<std::uint32_t> load(std::string_view keyword, const Name &name, std::uint32_t slot) {
        const std::optional<std::filesystem::path> file = find(name);
        const auto ignore = [&](std::string_view reason) {
            warn(fmt::format("{} {} is ignored: {}", keyword, quoteInput(name.text), reason));
            return std::nullopt;
        };
        if (!file) {
            warn(fmt::format("{} {}: there is no such file in the mesh's folder", keyword,
                             quoteInput(name.text)));
            return std::nullopt;
        }
        try {
            if (!isTextureFile(*file))
                return ignore("it is not a PNG, JPEG or Radiance (HDR) file");
            const std::uint32_t index = textures_.library.load(*file);
            if (textures_.library.at(index).isFloat() && slot != layout::slotEmission)
                return ignore("only map_Ke takes images of floats");
            const TextureLook &look = textures_.library.lookOf(index);
            if (slot == layout::slotNormal && look.isGrey)
                return ignore("it is grey, so a height map; only normal maps are read");
            if (slot == layout::slotNormal && keyword != "norm" && !look.isNormalMap)
                return ignore("its colours are not those of a normal map; height maps are not read");
            return index;
        } catch (const Error &error) {
            if (error.kind != ErrorKind::BadInput)
                throw;
            return ignore(error.what());
        }
    }

    std::filesystem::path base_;
    MtlTextures &textures_;
    const ObjLines &lines_;
};

/// Reads a statement; ignores unknown ones.
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

std::vector<Material> loadMtl(const std::filesystem::path &file, MtlTextures textures) {
    ObjLines lines(file);
    TextureReader textureReader(file, textures, lines);
    std::vector<Material> materials;
    std::unordered_set<std::string> names;
    std::optional<MtlStatements> current;
    const auto finish = [&] {
        if (current && names.insert(current->name).second) {
            textureReader.cutOut(*current);
            materials.push_back(materialOf(*current));
        }
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
        } else if (current && textureReader.take(*current, keyword, words)) {
            continue;
        } else if (knows(keyword)) {
            if (!current)
                lines.fail(fmt::format("{} comes before the first newmtl", keyword));
            take(*current, keyword, words);
        }
    }
    finish();
    return materials;
}

} // namespace hyalite
