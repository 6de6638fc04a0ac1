#include "host/import/mtl.h"

#include "host/base/clean_text.h"
#include "host/base/content_guess.h"
#include "host/base/error.h"
#include "host/base/interval.h"
#include "host/base/letter_case.h"
#include "host/image/texture_file.h"
#include "host/import/mtl_material.h"
#include "host/import/obj_lines.h"
#include "host/scene/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>

namespace hyalite::core {

namespace {

constexpr Interval anyNumber{std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max()};

/// A statement whose words have no meaning.
class UnreadableStatement : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The words of a line.
class Words {
  public:
    explicit Words(std::string_view line) : rest_(line) {}

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

    /// Numbers beyond `allowed` are its ends from now on.
    void limitTo(const Interval &allowed) { allowed_ = allowed; }
    /// The first number that was beyond, by more than rounding.
    [[nodiscard]] std::optional<float> firstBeyond() const { return beyond_; }

  private:
    [[nodiscard]] float parse(std::string_view keyword, std::string_view word) {
        std::string_view digits = word;
        if (digits.starts_with('+'))
            digits.remove_prefix(1);
        double wide = 0.0; // what is too small for a float is nearly 0
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), wide);
        const auto value = static_cast<float>(wide);
        if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
            throw UnreadableStatement(fmt::format("{} has {}", keyword,
                                                  word.empty()
                                                      ? "fewer numbers than it needs"
                                                      : quoteInput(word) + ", which is no finite number"));
        const double rounded = allowed_.rounded(wide);
        const double inside = std::clamp(rounded, allowed_.low, allowed_.high);
        if (!beyond_ && inside != rounded)
            beyond_ = value;
        return static_cast<float>(inside);
    }

    std::string_view rest_;
    Interval allowed_ = anyNumber;
    std::optional<float> beyond_;
};

/// Texture statements in small letters, and the slots that they fill.
struct TextureStatement {
    std::string_view keyword;
    std::optional<std::uint32_t> slot{}; ///< empty: left out
};

constexpr TextureStatement textureStatements[] = {
    {"map_kd", layout::slotBaseColour},
    {"map_ke", layout::slotEmission},
    {"map_pr", layout::slotRoughness},
    {"map_pm", layout::slotMetallic},
    {"norm", layout::slotNormal},
    {"map_norm", layout::slotNormal},
    {"map_kn", layout::slotNormal},
    {"map_bump", layout::slotNormal},
    {"bump", layout::slotNormal},
    {"map_d", layout::slotOpacity},
    {"map_opacity", layout::slotOpacity},
    {"map_ka"},
    {"map_ks"},
    {"map_ns"},
    {"map_ps"},
    {"map_pc"},
    {"map_tr"},
    {"map_tf"},
    {"map_refl"},
    {"map_disp"},
    {"disp"},
    {"decal"},
    {"refl"},
};

/// Reads the texture statements of one library.
class TextureReader {
  public:
    TextureReader(const std::filesystem::path &library, MtlTextures &textures, const ObjLines &lines)
        : base_(library.parent_path()), textures_(textures), lines_(lines) {}

    /// Returns whether `small` is a texture statement, and reads it if so. `keyword`: as the file has it.
    bool take(MtlStatements &mtl, std::string_view small, std::string_view keyword, Words &words) {
        const auto *const statement = std::ranges::find(textureStatements, small, &TextureStatement::keyword);
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
        if (name.empty()) {
            lose("no file", [&] { return fmt::format("{} names no file, and is left out", keyword); });
            return true;
        }
        if (!isPlaced(use.scale) || !isPlaced(use.offset) || !limits::normalStrength.contains(strength))
            throw UnreadableStatement(fmt::format(
                "{} has a -s, -o or -bm out of range (allowed are {} for -s and -o, and {} for -bm)", keyword,
                limits::texturePlacement.text(), limits::normalStrength.text()));
        if (small == "map_ka") {
            mtl.ambientName = std::string(name);
        } else if (!statement->slot) {
            loseTexture(small, keyword, name);
        } else {
            if (*statement->slot == layout::slotBaseColour)
                mtl.colourName = std::string(name);
            const std::optional<std::uint32_t> index = load(keyword, {name, hasOptions}, *statement->slot);
            if (!index)
                return true;
            use.textureIndex = *index;
            mtl.textures[*statement->slot] = use;
            if (*statement->slot == layout::slotNormal)
                mtl.normalStrength = strength;
            if (*statement->slot == layout::slotBaseColour)
                mtl.isCutOut = textures_.library.lookOf(*index).hasCutOuts;
        }
        return true;
    }

    /// Cuts out what is transparent in map_Kd, where there is no map_d. Call it when all of a material is read.
    void finish(MtlStatements &mtl) {
        // Ambient light is what a path tracer computes, but the picture may be the only one.
        if (!mtl.ambientName.empty() && mtl.ambientName != mtl.colourName)
            loseTexture("map_ka", "map_Ka", mtl.ambientName);
        if (!mtl.isCutOut || mtl.textures[layout::slotOpacity])
            return;
        mtl.textures[layout::slotOpacity] = mtl.textures[layout::slotBaseColour];
        lose("cut out", [&] {
            return fmt::format(
                "the material {} is cut out where map_Kd {} is transparent, as there is no map_d",
                quoteInput(mtl.name), quoteInput(mtl.colourName));
        });
    }

    /// Counts what is left out; `text()` says what, and why.
    template <class Text> void lose(std::string_view kind, const Text &text) {
        textures_.losses.add(
            kind, [&] { return fmt::format("{}:{}: {}", lines_.fileName(), lines_.lineNumber(), text()); });
    }

  private:
    void loseTexture(std::string_view kind, std::string_view keyword, std::string_view name) {
        lose(kind, [&] {
            return fmt::format("{} {} is left out; textures are read for {}", keyword, quoteInput(name),
                               "map_Kd, map_Ke, map_Pr, map_Pm, map_d, norm and map_Bump");
        });
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
            throw UnreadableStatement(fmt::format("{} has fewer numbers than it needs", option));
        if (isScale || isOffset)
            return;
        const bool hasWord = option == "-blendu" || option == "-blendv" || option == "-cc" ||
                             option == "-clamp" || option == "-colorspace" || option == "-imfchan" ||
                             option == "-type";
        const std::string_view value = hasWord ? words.next() : std::string_view();
        lose("option", [&] {
            return fmt::format("the option {}{}{} is left out; only -s, -o and -bm are read",
                               excerpt(option, maxExcerptBytes), hasWord ? " " : "",
                               excerpt(value, maxExcerptBytes));
        });
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
                lose("late option", [&] {
                    return fmt::format("{} is left out; options stand before the name",
                                       quoteInput(name.text.substr(options + 1)));
                });
        }
        return file;
    }

    std::optional<std::uint32_t> load(std::string_view keyword, const Name &name, std::uint32_t slot) {
        const std::optional<std::filesystem::path> file = find(name);
        const auto ignore = [&](std::string_view reason) {
            lose(reason, [&] {
                return fmt::format("{} {} is left out: {}", keyword, quoteInput(name.text), reason);
            });
            return std::nullopt;
        };
        if (!file)
            return ignore("there is no such file in the mesh's folder");
        try {
            if (!isTextureFile(*file))
                return ignore(foreignContent(
                    InputFile(*file),
                    "it is not a PNG, JPEG or Radiance (HDR) file, which are read: convert it"));
            const std::uint32_t index = textures_.library.load(*file);
            if (textures_.library.at(index).isFloat() && slot != layout::slotEmission)
                return ignore("only map_Ke takes images of floats");
            const TextureLook &look = textures_.library.lookOf(index);
            const bool isBump = keyword.ends_with("ump");
            if (slot == layout::slotNormal && look.isGrey)
                return ignore("it is grey, so a height map; only normal maps are read");
            if (slot == layout::slotNormal && isBump && !look.isNormalMap)
                return ignore("its colours are not those of a normal map; height maps are not read");
            return index;
        } catch (const Error &error) {
            if (error.kind != ErrorKind::BadInput)
                throw;
            lose("damaged texture", [&] {
                return fmt::format("{} {} is left out: {}", keyword, quoteInput(name.text), error.what());
            });
            return std::nullopt;
        }
    }

    std::filesystem::path base_;
    MtlTextures &textures_;
    const ObjLines &lines_;
};

/// Statements of numbers, in small letters. Numbers beyond the range are its ends.
struct NumberStatement {
    std::string_view keyword;
    Interval range;
    void (*take)(MtlStatements &mtl, std::string_view keyword, Words &words);
};

template <auto member> void takeColour(MtlStatements &mtl, std::string_view keyword, Words &words) {
    mtl.*member = words.colour(keyword);
}

template <auto member> void takeNumber(MtlStatements &mtl, std::string_view keyword, Words &words) {
    mtl.*member = words.number(keyword);
}

constexpr NumberStatement numberStatements[] = {
    {"kd", limits::fraction, takeColour<&MtlStatements::diffuse>},
    {"ks", limits::fraction, takeColour<&MtlStatements::specular>},
    {"ke", limits::radiance, takeColour<&MtlStatements::emission>},
    {"ns", anyNumber, takeNumber<&MtlStatements::exponent>},
    {"pr", limits::fraction, takeNumber<&MtlStatements::roughness>},
    {"pm", limits::fraction, takeNumber<&MtlStatements::metallic>},
    {"pc", limits::fraction, takeNumber<&MtlStatements::clearcoat>},
    {"pcr", limits::fraction, takeNumber<&MtlStatements::clearcoatRoughness>},
    {"tr", limits::fraction, takeNumber<&MtlStatements::transparency>},
    {"d", limits::fraction,
     [](auto &mtl, auto keyword, Words &words) {
         if (words.isAtOption())
             (void)words.next(); // -halo: opaque only where it is seen head on
         mtl.dissolve = words.number(keyword);
     }},
    // Programs write 0 for what does not refract, and numbers of their own for how they shade.
    {"ni", anyNumber,
     [](auto &mtl, auto keyword, Words &words) {
         mtl.index = std::clamp(words.number(keyword), 1.0f, 10.0f);
     }},
    {"illum", anyNumber,
     [](auto &mtl, auto keyword, Words &words) {
         mtl.illumination = static_cast<int>(std::clamp(words.number(keyword), 0.0f, 10.0f));
     }},
};

/// Statements that are left out, and the numbers of theirs that change nothing.
struct UnusedStatement {
    std::string_view keyword;
    std::array<float, 2> harmless{};
    std::string_view reason{};
};

constexpr UnusedStatement unusedStatements[] = {
    {"tf", {0.0f, 1.0f}, "glass is not tinted"},
    {"ps", {0.0f, 0.0f}, "there is no sheen"},
    {"aniso", {0.0f, 0.0f}, "there is no anisotropy"},
    {"anisor", {0.0f, 0.0f}, "there is no anisotropy"},
};

/// Ambient light is what a path tracer computes; the others say how other programs filter and mirror.
constexpr std::string_view needlessStatements[] = {"ka", "sharpness", "map_aat"};

/// Reads the statements of one library.
class MtlReader {
  public:
    MtlReader(const std::filesystem::path &file, MtlTextures textures)
        : lines_(file), textures_(textures), textureReader_(file, textures_, lines_) {}

    [[nodiscard]] std::vector<Material> read() {
        if (const std::string guess = guessContent(lines_.head()); !guess.empty()) {
            textureReader_.lose("foreign", [&] { return "this is not MTL text; it looks like " + guess; });
            return {};
        }
        while (const std::optional<std::span<char>> line = lines_.next()) {
            Words words({line->data(), line->size()});
            const std::string_view keyword = words.next();
            const std::string small = lowerCase(keyword);
            try {
                take(small, keyword, words);
            } catch (const UnreadableStatement &unreadable) {
                textureReader_.lose(
                    small, [&] { return fmt::format("{}; the statement is left out", unreadable.what()); });
            }
        }
        finish();
        return std::move(materials_);
    }

  private:
    void take(const std::string &small, std::string_view keyword, Words &words) {
        if (keyword.empty())
            return;
        if (small == "newmtl") {
            finish();
            current_.emplace();
            current_->name = std::string(words.remainder());
            return;
        }
        if (!current_) {
            textureReader_.lose("no material", [&] {
                return fmt::format("{} comes before the first newmtl, and is left out",
                                   excerpt(keyword, maxExcerptBytes));
            });
            return;
        }
        if (textureReader_.take(*current_, small, keyword, words))
            return;
        if (const auto *row = std::ranges::find(numberStatements, small, &NumberStatement::keyword);
            row != std::end(numberStatements)) {
            words.limitTo(row->range);
            row->take(*current_, keyword, words);
            if (const std::optional<float> beyond = words.firstBeyond())
                textureReader_.lose("range", [&] {
                    return fmt::format("{} {} counts as {}; allowed are {}", keyword, *beyond,
                                       std::clamp<double>(*beyond, row->range.low, row->range.high),
                                       row->range.text());
                });
        } else if (const auto *unused = std::ranges::find(unusedStatements, small, &UnusedStatement::keyword);
                   unused != std::end(unusedStatements))
            leaveOut(*unused, keyword, words);
        else if (std::ranges::find(needlessStatements, small) == std::end(needlessStatements))
            textureReader_.lose("unknown", [&] {
                return fmt::format("the statement {} is unknown, and left out", quoteInput(keyword));
            });
    }

    void leaveOut(const UnusedStatement &unused, std::string_view keyword, Words &words) {
        while (const std::optional<float> number = words.tryNumber())
            if (std::ranges::find(unused.harmless, *number) == unused.harmless.end()) {
                textureReader_.lose(unused.keyword, [&] {
                    return fmt::format("{} {} is left out: {}", keyword, *number, unused.reason);
                });
                return;
            }
    }

    void finish() {
        if (current_ && names_.insert(current_->name).second) {
            textureReader_.finish(*current_);
            if (!current_->dissolve && current_->transparency == 1.0f)
                textureReader_.lose("tr 1", [&] {
                    return fmt::format(
                        "the material {} has Tr 1 without d: it is taken for opaque, as programs mean "
                        "it that write so",
                        quoteInput(current_->name));
                });
            if (current_->clearcoat > 0.0f && opacityOf(*current_) < 1.0f)
                textureReader_.lose("coat of glass", [&] {
                    return fmt::format("Pc of the material {} is left out: what is transparent has no coat",
                                       quoteInput(current_->name));
                });
            materials_.push_back(materialOf(*current_));
        }
        if (materials_.size() > limits::materialCount)
            lines_.fail(fmt::format("there are more than {} materials", limits::materialCount));
    }

    ObjLines lines_;
    MtlTextures textures_;
    TextureReader textureReader_;
    std::vector<Material> materials_;
    std::unordered_set<std::string> names_;
    std::optional<MtlStatements> current_;
};

} // namespace

std::vector<Material> loadMtl(const std::filesystem::path &file, MtlTextures textures) {
    return MtlReader(file, textures).read();
}

} // namespace hyalite::core
