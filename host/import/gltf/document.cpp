#include "host/import/gltf/document.h"

#include "host/base/input_file.h"
#include "host/base/json_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace hyalite::gltf {
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
};

/// The chunks of a .glb: JSON first, then binary data, then others.
std::vector<Chunk> chunksOf(const InputFile &file) {
    if (const std::uint32_t version = wordAt(file, 4); version != 2)
        throw file.bad(fmt::format("is a GLB of version {}; allowed: 2", version));
    const std::uint64_t sizeBytes = wordAt(file, 8);
    if (sizeBytes != file.sizeBytes())
        throw file.bad(fmt::format("its header says {} bytes, but it has {}", sizeBytes, file.sizeBytes()));
    std::vector<Chunk> chunks;
    std::uint64_t offset = headerBytes;
    while (offset < sizeBytes) {
        if (sizeBytes - offset < chunkHeaderBytes)
            throw file.bad(fmt::format("ends within the header of chunk {}", chunks.size()));
        const Chunk chunk{offset + chunkHeaderBytes, wordAt(file, offset), wordAt(file, offset + 4)};
        if (chunk.sizeBytes > sizeBytes - chunk.offset)
            throw file.bad(
                fmt::format("its chunk {} of {} bytes ends behind the file", chunks.size(), chunk.sizeBytes));
        if (chunk.sizeBytes % 4 != 0)
            throw file.bad(fmt::format("its chunk {} has {} bytes; allowed: a multiple of 4", chunks.size(),
                                       chunk.sizeBytes));
        chunks.push_back(chunk);
        offset = chunk.offset + chunk.sizeBytes;
    }
    if (chunks.empty() || chunks[0].type != jsonType)
        throw file.bad("its first chunk is not JSON");
    return chunks;
}

/// What all elements of the arrays of the top level are.
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
    if (!version.text().starts_with("2."))
        version.refuse("2.0");
    if (const auto least = asset.find("minVersion"); least && least->text() != "2.0")
        least->refuse("2.0");
}

} // namespace

Document::Document(const std::filesystem::path &file) : path_(file), fileName_(file.string()) {
    const InputFile input(file);
    sizeBytes_ = input.sizeBytes();
    std::string text;
    if (isBinary(input)) {
        const std::vector<Chunk> chunks = chunksOf(input);
        text = textAt(input, chunks[0].offset, chunks[0].sizeBytes);
        if (chunks.size() > 1 && chunks[1].type == binaryType) {
            binaryChunk_.resize(static_cast<std::size_t>(chunks[1].sizeBytes));
            input.read(chunks[1].offset, binaryChunk_);
        }
    } else {
        text = textAt(input, 0, sizeBytes_);
    }
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

std::optional<JsonObject> extensionOf(const JsonObject &object, std::string_view name) {
    const std::optional<JsonNode> extensions = object.find("extensions");
    if (!extensions)
        return std::nullopt;
    const std::optional<JsonNode> extension = JsonObject(*extensions).find(name);
    return extension ? std::optional(JsonObject(*extension)) : std::nullopt;
}

std::string nameOf(const JsonObject &object) { return object.text("name", ""); }

} // namespace hyalite::gltf
