#include "host/import/gltf/document.h"

#include "host/base/content_guess.h"
#include "host/base/input_file.h"
#include "host/base/json_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>

namespace hyalite::core::gltf {
namespace {

constexpr std::uint64_t maxJsonBytes = std::uint64_t{512} << 20;
constexpr std::size_t headerBytes = 12;          ///< of a .glb
constexpr std::size_t chunkHeaderBytes = 8;      ///< length and type
constexpr std::uint32_t magic = 0x46546C67;      ///< "glTF"
constexpr std::uint32_t jsonType = 0x4E4F534A;   ///< "JSON"
constexpr std::uint32_t binaryType = 0x004E4942; ///< "BIN"

std::uint32_t wordAt(const InputFile &file, std::uint64_t offset) {
    std::uint8_t bytes[4];
    file.read(offset, std::as_writable_bytes(std::span(bytes)));
    return bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
           std::uint32_t{bytes[3]} << 24;
}

bool isBinary(const InputFile &file) { return file.sizeBytes() >= headerBytes && wordAt(file, 0) == magic; }

std::string textAt(const InputFile &file, std::uint64_t offset, std::uint64_t sizeBytes) {
    if (sizeBytes > maxJsonBytes)
        throw file.bad(
            fmt::format("has {} bytes of JSON; at most {} (512 MiB) are read", sizeBytes, maxJsonBytes));
    std::string text(static_cast<std::size_t>(sizeBytes), '\0');
    file.read(offset, std::as_writable_bytes(std::span(text)));
    return text;
}

struct Chunk {
    std::uint64_t offset = 0;
    std::uint64_t sizeBytes = 0;
    std::uint32_t type = 0;

    [[nodiscard]] std::uint64_t end() const { return offset + sizeBytes; }
};

/// The chunk whose header begins there. Without its padding, of 3 bytes at most, it is whole, too.
Chunk chunkAt(const InputFile &file, std::uint64_t offset) {
    if (file.sizeBytes() < offset + chunkHeaderBytes)
        throw file.bad(fmt::format("ends within the header of the chunk at byte {}", offset));
    Chunk chunk{offset + chunkHeaderBytes, wordAt(file, offset), wordAt(file, offset + 4)};
    if (chunk.end() > file.sizeBytes() + 3)
        throw file.bad(
            fmt::format("its header says {} bytes, but it has {}: the chunk at byte {}, of {} bytes, "
                        "ends behind the file",
                        wordAt(file, 8), file.sizeBytes(), offset, chunk.sizeBytes));
    chunk.sizeBytes = std::min(chunk.sizeBytes, file.sizeBytes() - chunk.offset);
    return chunk;
}

/// Of glTF 1.0, which assimp reads.
constexpr std::string_view convertingHint =
    ", which `assimp export OLD.glb NEW.glb` makes of it (Debian: assimp-utils)";

struct Chunks {
    Chunk json;
    std::optional<Chunk> binary;
};

/// The JSON of a .glb and its binary data, by the lengths of chunks. These should be multiples of 4; behind another one
/// the next chunk follows at once or at a multiple of 4, wherever binary data begins.
Chunks chunksOf(const InputFile &file, Losses &losses) {
    if (const std::uint32_t version = wordAt(file, 4); version != 2)
        throw file.bad(
            fmt::format("is a GLB of version {}; allowed: 2{}", version, version == 1 ? convertingHint : ""));
    Chunks chunks{chunkAt(file, headerBytes), {}};
    if (chunks.json.type != jsonType)
        throw file.bad("its first chunk is not JSON");
    const auto isBinaryAt = [&](std::uint64_t offset) {
        return offset + chunkHeaderBytes <= file.sizeBytes() && wordAt(file, offset + 4) == binaryType;
    };
    const std::uint64_t statedBytes = wordAt(file, 8);
    std::uint64_t offset = chunks.json.end();
    while (offset < file.sizeBytes() && !chunks.binary) {
        if (!isBinaryAt(offset))
            offset = (offset + 3) / 4 * 4;
        if (offset + chunkHeaderBytes > file.sizeBytes() || (offset >= statedBytes && !isBinaryAt(offset)))
            break; // padding, or bytes behind the end
        const Chunk chunk = chunkAt(file, offset);
        if (chunk.type == binaryType)
            chunks.binary = chunk;
        offset = chunk.end();
    }
    if (statedBytes != file.sizeBytes())
        losses.add("length of the file", [&] {
            return fmt::format(
                "{}: its header says {} bytes, but it has {}; its chunks are read by their own "
                "lengths",
                file.path().string(), statedBytes, file.sizeBytes());
        });
    return chunks;
}

/// Throws unless all elements of the arrays of the top level are objects.
void checkObjects(const JsonObject &top) {
    for (const std::string_view array :
         {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials", "meshes",
          "nodes", "samplers", "scenes", "skins", "textures"})
        for (const JsonNode &element : elementsOf(top, array))
            static_cast<void>(nameOf(JsonObject(element)));
}

void checkVersion(const JsonObject &top) {
    const JsonObject asset(top.at("asset"));
    const JsonNode version = asset.at("version");
    if (*version.value == 2) // a number, as some programs write it
        return;
    if (!version.text().starts_with("2."))
        version.refuse(fmt::format("2.0{}", version.text().starts_with("1.") ? convertingHint : ""));
    if (const auto least = asset.find("minVersion"); least && least->text() != "2.0")
        least->refuse("2.0");
}

} // namespace

Document::Document(const std::filesystem::path &file) : path_(file), fileName_(file.string()) {
    const InputFile input(file);
    sizeBytes_ = input.sizeBytes();
    std::string text;
    if (isBinary(input)) {
        const Chunks chunks = chunksOf(input, *losses_);
        text = textAt(input, chunks.json.offset, chunks.json.sizeBytes);
        if (chunks.binary) {
            binaryChunk_.resize(static_cast<std::size_t>(chunks.binary->sizeBytes));
            input.read(chunks.binary->offset, binaryChunk_);
        }
    } else {
        const std::vector<std::byte> head = input.head(guessedBytes);
        const std::string guess = guessContent({reinterpret_cast<const char *>(head.data()), head.size()});
        if (!guess.empty())
            throw input.bad(fmt::format("this is neither JSON nor a GLB; it looks like {}", guess));
        text = textAt(input, 0, sizeBytes_);
    }
    text.resize(text.find_last_not_of('\0') + 1); // padding
    json_ = parseJson(text, fileName_);
    checkVersion(top());
    checkObjects(top());
}

std::size_t Document::count(std::string_view array) const {
    const std::optional<JsonNode> node = top().find(array);
    if (!node)
        return 0;
    if (!node->value->is_array())
        node->refuse("an array");
    return node->value->size();
}

JsonNode Document::at(std::string_view array, std::size_t index) const {
    const JsonNode node = top().at(array);
    return {&(*node.value)[index], &fileName_, node.path / index};
}

std::size_t Document::reference(const JsonNode &node, std::string_view array) const {
    const std::size_t elementCount = count(array);
    if (elementCount == 0)
        node.refuse(fmt::format("an index of {}, of which there are none", array));
    return static_cast<std::size_t>(node.wholeNumber({0.0, static_cast<double>(elementCount - 1)}));
}

std::optional<std::size_t> Document::reference(const JsonObject &object, std::string_view key,
                                               std::string_view array) const {
    const std::optional<JsonNode> node = object.find(key);
    return node ? std::optional(reference(*node, array)) : std::nullopt;
}

Elements elementsOf(const JsonObject &object, std::string_view key) {
    const std::optional<JsonNode> node = object.find(key);
    if (!node)
        return {};
    if (!node->value->is_array())
        node->refuse("an array");
    return Elements(*node);
}

std::vector<double> numbersOf(const JsonNode &node, std::size_t count, const Interval &allowed) {
    if (!node.value->is_array() || node.value->size() != count)
        node.refuse(fmt::format("an array of {} numbers", count));
    std::vector<double> numbers;
    numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        numbers.push_back(JsonNode{&(*node.value)[i], node.fileName, node.path / i}.number(allowed));
    return numbers;
}

double clampedNumber(const Document &document, const JsonNode &node, const Interval &allowed) {
    const double number = node.number(anyNumber);
    const double clamped = std::clamp(number, allowed.low, allowed.high);
    if (clamped != number)
        document.losses().add("number beyond its range", [&] {
            return fmt::format("{}: {}: {} counts as {}; allowed: {}", document.fileName(),
                               node.path.to_string(), number, clamped, allowed.text());
        });
    return clamped;
}

double clampedNumber(const Document &document, const JsonObject &object, std::string_view key,
                     const Interval &allowed, double fallback) {
    const std::optional<JsonNode> node = object.find(key);
    return node ? clampedNumber(document, *node, allowed) : fallback;
}

std::vector<double> clampedNumbers(const Document &document, const JsonNode &node, std::size_t count,
                                   const Interval &allowed) {
    std::vector<double> numbers = numbersOf(node, count);
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = clampedNumber(document, {&(*node.value)[i], node.fileName, node.path / i}, allowed);
    return numbers;
}

std::optional<JsonObject> extensionOf(const JsonObject &object, std::string_view name) {
    const std::optional<JsonNode> extensions = object.find("extensions");
    if (!extensions)
        return std::nullopt;
    const std::optional<JsonNode> extension = JsonObject(*extensions).find(name);
    return extension ? std::optional(JsonObject(*extension)) : std::nullopt;
}

std::string nameOf(const JsonObject &object) { return object.text("name", ""); }

} // namespace hyalite::core::gltf
