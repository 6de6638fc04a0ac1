#include "host/import/stl.h"

#include "host/base/content_guess.h"
#include "host/base/error.h"
#include "host/base/letter_case.h"
#include "host/import/mesh_builder.h"
#include "host/import/obj_lines.h"
#include "host/import/obj_statement.h"
#include "host/import/whole_file.h"
#include "host/scene/origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

namespace hyalite::core {
namespace {

constexpr std::size_t headBytes = 84; ///< 80 of text, and the number of triangles
constexpr std::size_t triangleBytes = 50;
constexpr std::uint64_t stepTriangles = 65536; ///< between two reports of progress

/// Numbers the distinct vertices of a mesh, from 0, in the order in which they come. Vertices whose coordinates are
/// equal as floats are one; `isExact`: relative to the first one. A hash table with open addressing.
class VertexMerger {
  public:
    VertexMerger(MeshBuilder &builder, bool isExact)
        : builder_(builder), places_(1024, none), isExact_(isExact) {}

    [[nodiscard]] MeshBuilder &builder() { return builder_; }
    /// Whether floats do not hold the digits of the vertices.
    [[nodiscard]] bool areFar() const { return finder_.origin() != glm::dvec3(0.0); }

    /// The number of the vertex, which is added to the builder the first time.
    std::uint32_t add(const glm::dvec3 &position, std::size_t place) {
        if (std::isfinite(position.x + position.y + position.z))
            finder_.add(position);
        if (isExact_ && keys_.empty())
            first_ = position;
        const Key key = keyOf(glm::vec3(position - first_));
        std::size_t slot = hashOf(key) & (places_.size() - 1);
        while (places_[slot] != none) {
            if (keys_[places_[slot]] == key)
                return places_[slot];
            slot = (slot + 1) & (places_.size() - 1);
        }
        builder_.addPosition(isExact_ ? position : glm::dvec3(glm::vec3(position)), place);
        const auto number = static_cast<std::uint32_t>(keys_.size());
        places_[slot] = number;
        keys_.push_back(key);
        if (keys_.size() * 2 > places_.size())
            grow();
        return number;
    }

  private:
    using Key = std::array<std::uint32_t, 3>;
    static constexpr std::uint32_t none = 0xFFFF'FFFF;

    /// The bits of the coordinates; 0 and -0 are the same place.
    static Key keyOf(const glm::vec3 &position) {
        Key key{};
        for (glm::length_t axis = 0; axis < 3; ++axis)
            key[static_cast<std::size_t>(axis)] =
                std::bit_cast<std::uint32_t>(position[axis] == 0.0f ? 0.0f : position[axis]);
        return key;
    }

    static std::size_t hashOf(const Key &key) {
        std::uint64_t hash = key[0] * 0x9E3779B97F4A7C15u;
        for (const std::uint32_t part : {key[1], key[2]})
            hash = (std::rotl(hash, 29) ^ part) * 0x9E3779B97F4A7C15u;
        return static_cast<std::size_t>(hash ^ (hash >> 32u));
    }

    void grow() {
        places_.assign(places_.size() * 2, none);
        for (std::uint32_t number = 0; number < keys_.size(); ++number) {
            std::size_t slot = hashOf(keys_[number]) & (places_.size() - 1);
            while (places_[slot] != none)
                slot = (slot + 1) & (places_.size() - 1);
            places_[slot] = number;
        }
    }

    MeshBuilder &builder_;
    std::vector<Key> keys_;             ///< by number
    std::vector<std::uint32_t> places_; ///< numbers; a power of two
    bool isExact_;
    glm::dvec3 first_{0.0}; ///< position, if exact
    OriginFinder finder_;
};

FaceCorner cornerOf(std::uint32_t number) { return {static_cast<std::int32_t>(number) + 1, 0, 0}; }

template <class T> T littleEndian(const char *at) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), at, sizeof(T));
    if constexpr (std::endian::native == std::endian::big)
        std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
}

void readBinary(std::span<const char> bytes, const std::string &fileName, VertexMerger &merger,
                const OnReading &onReading) {
    MeshBuilder &builder = merger.builder();
    const auto announced = littleEndian<std::uint32_t>(bytes.data() + 80);
    const std::size_t present = (bytes.size() - headBytes) / triangleBytes;
    const std::string guess = guessBySignature(bytes);
    if (announced > present && (present == 0 || !guess.empty()))
        throw Error(
            ErrorKind::BadInput,
            fmt::format("{}: it announces {} triangles, and has bytes for {}: it is cut short, or is not "
                        "STL{}{}",
                        fileName, announced, present, guess.empty() ? "" : "; it looks like ", guess));
    // Programs that write as they go leave 0, or the largest number.
    const auto count = static_cast<std::uint32_t>(announced == 0 ? std::min<std::size_t>(present, 0xFFFF'FFFF)
                                                                 : std::min<std::size_t>(announced, present));
    if (count != announced || count < present)
        builder.losses().add("count", [&] {
            return fmt::format("{}: it announces {} triangles, and has bytes for {}: {} are read", fileName,
                               announced, present, count);
        });
    if (std::string_view(bytes.data(), 80).find("COLOR=") != std::string_view::npos)
        builder.losses().add("colour of all",
                             [&] { return fileName + ": the colour of its header is left out"; });
    builder.reserve(0, count);
    for (std::uint32_t triangle = 0; triangle < count; ++triangle) {
        if (onReading && triangle % stepTriangles == stepTriangles - 1)
            onReading(static_cast<double>(triangle) / count);
        const std::size_t offset = headBytes + std::size_t{triangle} * triangleBytes;
        std::array<FaceCorner, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const char *const at = bytes.data() + offset + 12 + 12 * i; // after the normal
            corners[i] = cornerOf(merger.add(
                {littleEndian<float>(at), littleEndian<float>(at + 4), littleEndian<float>(at + 8)}, offset));
        }
        builder.addFace(corners, offset);
        if (littleEndian<std::uint16_t>(bytes.data() + offset + 48) != 0)
            builder.losses().add("colours", [&] {
                return placeText(fileName, PlaceUnit::Byte, offset + 48) +
                       "what stands behind a triangle, a colour perhaps, is left out";
            });
    }
}

bool isWord(std::string_view word, std::string_view lower) {
    return std::ranges::equal(word, lower, [](char a, char b) { return lowerCase(a) == b; });
}

constexpr std::string_view keywords[] = {"facet",    "outer", "vertex",   "endloop",
                                         "endfacet", "solid", "endsolid", "color"};

/// The words of text, whose case does not matter, with their lines.
class StlWords {
  public:
    StlWords(std::span<const char> text, const std::string &fileName)
        : begin_(text.data()), at_(text.data()), end_(text.data() + text.size()), fileName_(fileName) {}

    /// Empty at the end of the file.
    std::string_view next() {
        for (; at_ != end_ && isBlank(*at_); ++at_)
            if (*at_ == '\n' || (*at_ == '\r' && (at_ + 1 == end_ || at_[1] != '\n')))
                ++line_;
        const char *const begin = at_;
        while (at_ != end_ && !isBlank(*at_))
            ++at_;
        return {begin, at_};
    }

    /// The next word, without consuming it.
    [[nodiscard]] std::string_view peek() const { return StlWords(*this).next(); }

    /// Whether the next words are "facet normal".
    [[nodiscard]] bool isAtFacet() const {
        StlWords ahead(*this);
        return isWord(ahead.next(), "facet") && isWord(ahead.next(), "normal");
    }

    /// Whether no word is left on this line.
    [[nodiscard]] bool isLineOver() {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\t'))
            ++at_;
        return at_ == end_ || isBlank(*at_);
    }

    /// 0 at the end of the file, which isCut() then tells.
    double number() {
        const std::string_view word = next();
        const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
        double value = 0.0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        const bool isRead = end == digits.data() + digits.size() && !digits.empty();
        if (!isRead && peek().empty() &&
            word.find_first_not_of("+-.0123456789Ee") == std::string_view::npos) {
            isCut_ = true;
            return 0.0;
        }
        if (!isRead || (error != std::errc() && error != std::errc::result_out_of_range))
            fail("a vertex has " + quoteInput(word) + "; allowed are three finite decimal numbers");
        return value;
    }

    /// Whether the file ends within a vertex or, as `word` is its last one, within a keyword.
    [[nodiscard]] bool isCut(std::string_view word = {}) const {
        return isCut_ || (!word.empty() && peek().empty() &&
                          std::ranges::any_of(keywords, [&](std::string_view keyword) {
                              return isWord(word, keyword.substr(0, word.size()));
                          }));
    }

    [[nodiscard]] std::size_t line() const { return line_; }
    [[nodiscard]] double shareRead() const {
        return static_cast<double>(at_ - begin_) / static_cast<double>(end_ - begin_);
    }
    [[noreturn]] void fail(std::string_view message) const { failAtLine(fileName_, line_, message); }

  private:
    static bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    const char *begin_;
    const char *at_;
    const char *end_;
    std::size_t line_ = 1;
    bool isCut_ = false;
    const std::string &fileName_;
};

/// Passes over as many words that are no keywords.
void skipArguments(StlWords &words, int most) {
    for (int i = 0; i < most; ++i) {
        const std::string_view word = words.peek();
        if (std::ranges::any_of(keywords, [&](std::string_view keyword) { return isWord(word, keyword); }))
            return;
        (void)words.next();
    }
}

void readText(std::span<const char> bytes, const std::string &fileName, VertexMerger &merger,
              const OnReading &onReading) {
    MeshBuilder &builder = merger.builder();
    StlWords words(bytes, fileName);
    std::vector<FaceCorner> corners;
    std::uint64_t faceCount = 0;
    bool isCut = false;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (isWord(word, "vertex")) {
            const double x = words.number();
            const double y = words.number();
            const double z = words.number();
            if (words.isCut())
                break;
            corners.push_back(cornerOf(merger.add({x, y, z}, words.line())));
            if (corners.size() > maxFaceCorners)
                words.fail(fmt::format("the facet has more than {} vertices", maxFaceCorners));
        } else if (isWord(word, "endloop")) {
            builder.addFace(corners, words.line());
            corners.clear();
            if (onReading && ++faceCount % stepTriangles == 0)
                onReading(words.shareRead());
        } else if (isWord(word, "solid") || isWord(word, "endsolid")) {
            while (!words.isLineOver() && !words.isAtFacet()) // its name
                (void)words.next();
        } else if (isWord(word, "facet")) {
            skipArguments(words, 4); // "normal" and its numbers
        } else if (isWord(word, "outer")) {
            skipArguments(words, 1); // "loop"
        } else if (isWord(word, "color")) {
            skipArguments(words, 3);
            builder.losses().add("colours", [&] {
                return placeText(fileName, PlaceUnit::Line, words.line()) + "a colour is left out";
            });
        } else if (words.isCut(word) && !isWord(word, "endfacet")) {
            isCut = true;
            break;
        } else if (!isWord(word, "endfacet")) {
            words.fail(
                fmt::format("{} is no word of STL; allowed are solid, facet, outer loop, vertex, endloop, "
                            "endfacet and endsolid",
                            quoteInput(word)));
        }
    }
    if (!corners.empty() || isCut || words.isCut())
        builder.losses().add("cut", [&] {
            return placeText(fileName, PlaceUnit::Line, words.line()) +
                   "the file ends within a facet, which is left out: it is cut short";
        });
}

/// Whether it has the length of the binary file that it would be.
bool hasBinarySize(std::span<const char> bytes) {
    return bytes.size() >= headBytes &&
           bytes.size() ==
               headBytes + std::uint64_t{littleEndian<std::uint32_t>(bytes.data() + 80)} * triangleBytes;
}

/// Without a byte order mark, and the padding behind it: zeros, and the end of file of DOS.
std::span<const char> withoutPadding(std::span<const char> bytes) {
    constexpr std::string_view padding("\0\x1A \t\r\n", 6);
    const std::size_t end = std::string_view(bytes.data(), bytes.size()).find_last_not_of(padding) + 1;
    const std::size_t begin = std::min(byteOrderMarkBytes(bytes), end);
    return bytes.subspan(begin, end - begin);
}

bool beginsAsText(std::span<const char> bytes) {
    const std::string noName;
    const std::span<const char> head = bytes.first(std::min<std::size_t>(bytes.size(), headBytes));
    return isWord(StlWords(head.subspan(byteOrderMarkBytes(head)), noName).next(), "solid");
}

bool isBinary(std::span<const char> bytes) {
    return hasBinarySize(bytes) || (bytes.size() >= headBytes && !beginsAsText(bytes));
}

} // namespace

bool isStl(std::span<const char> bytes) { return hasBinarySize(bytes) || beginsAsText(bytes); }

ObjMesh loadStl(const std::filesystem::path &file, const MeshTransform &transform,
                const OnReading &onReading) {
    const std::string fileName = file.string();
    const std::vector<char> whole = readWholeFile(file);
    const bool isInBinary = isBinary(whole);
    const std::span<const char> bytes = isInBinary ? std::span(whole) : withoutPadding(whole);
    bool areFar = false;
    const auto read = [&](const glm::dvec3 &origin) {
        MeshBuilder builder(fileName, transform, origin, isInBinary ? PlaceUnit::Byte : PlaceUnit::Line);
        builder.report().files.push_back(file);
        VertexMerger merger(builder, areFar);
        if (isInBinary)
            readBinary(bytes, fileName, merger, onReading);
        else
            readText(bytes, fileName, merger, onReading);
        areFar = merger.areFar();
        return builder.finish();
    };
    ObjMesh loaded = readNear(read);
    if (areFar && loaded.mesh.origin == glm::dvec3(0.0)) // its transform brings it near
        loaded = read(glm::dvec3(0.0));
    return loaded;
}

MeshFile readStlMeshes(const std::filesystem::path &file, const MeshOptions &options) {
    return meshFileOf(loadStl(file, options.transform, options.onReading));
}

} // namespace hyalite::core
