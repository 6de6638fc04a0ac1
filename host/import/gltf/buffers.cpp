#include "host/import/gltf/buffers.h"

#include "host/base/input_file.h"
#include "host/import/gltf/meshopt.h"
#include "host/import/gltf/uri.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

namespace hyalite::core::gltf {
namespace {

constexpr Interval strideRange{4, 252};

/// The bytes from "byteOffset" on, "byteLength" of them.
std::span<const std::byte> partOf(std::span<const std::byte> whole, const JsonObject &object) {
    const auto offset = object.integer<std::size_t>("byteOffset", byteCount, std::size_t{0});
    const JsonNode length = object.at("byteLength");
    const auto sizeBytes = static_cast<std::size_t>(length.wholeNumber({1.0, byteCount.high}));
    if (offset > whole.size())
        object.at("byteOffset").refuse(fmt::format("at most {}, the length of the buffer", whole.size()));
    if (sizeBytes > whole.size() - offset)
        length.refuse(
            fmt::format("at most {}: the buffer has {} bytes", whole.size() - offset, whole.size()));
    return whole.subspan(offset, sizeBytes);
}

/// 0, as some programs write it, means the same as none: elements are packed.
std::size_t strideOf(const JsonObject &object) {
    const std::optional<JsonNode> stride = object.find("byteStride");
    return !stride || *stride->value == 0 ? 0 : static_cast<std::size_t>(stride->wholeNumber(strideRange));
}

} // namespace

std::vector<std::byte> Buffers::readBuffer(const JsonNode &uri) {
    if (std::optional<std::vector<std::byte>> data = dataOf(uri))
        return std::move(*data);
    const std::filesystem::path path = access_.resolve(uri, fileNameOf(uri));
    const InputFile file(path);
    memoryBudget_.addFile(file.sizeBytes());
    files_.push_back(path);
    return file.head(static_cast<std::size_t>(file.sizeBytes()));
}

std::span<const std::byte> Buffers::buffer(std::size_t index) {
    if (const auto known = buffers_.find(index); known != buffers_.end())
        return known->second;
    const JsonObject object(document_.at("buffers", index));
    const JsonNode length = object.at("byteLength");
    const auto sizeBytes = static_cast<std::size_t>(length.wholeNumber({1.0, byteCount.high}));
    std::span<const std::byte> bytes;
    if (const std::optional<JsonNode> uri = object.find("uri")) {
        const std::string key = uri->text();
        const auto known = fileContents_.find(key);
        if (known != fileContents_.end()) {
            bytes = known->second;
        } else {
            storage_.push_back(std::make_unique<std::vector<std::byte>>(readBuffer(*uri)));
            bytes = *storage_.back();
            fileContents_.emplace(key, bytes);
        }
    } else if (index == 0) {
        bytes = document_.binaryChunk();
    }
    if (bytes.size() < sizeBytes)
        length.fail(fmt::format("found {}, but the buffer has {} bytes", sizeBytes, bytes.size()));
    bytes = bytes.first(sizeBytes);
    buffers_.emplace(index, bytes);
    return bytes;
}

BufferView Buffers::plainView(const JsonNode &node) {
    const JsonObject object(node);
    const std::size_t index = document_.reference(object.at("buffer"), "buffers");
    BufferView view{partOf(buffer(index), object)};
    view.stride = strideOf(object);
    return view;
}

BufferView Buffers::decompressedView(const JsonNode &node, const JsonObject &compression) {
    const std::size_t index = document_.reference(compression.at("buffer"), "buffers");
    const std::span<const std::byte> packed = partOf(buffer(index), compression);
    storage_.push_back(std::make_unique<std::vector<std::byte>>(decompressMeshopt(
        compression, packed, [&](std::size_t sizeBytes) { memoryBudget_.take(sizeBytes, node); })));
    BufferView view{*storage_.back()};
    const JsonNode length = JsonObject(node).at("byteLength");
    if (length.wholeNumber(byteCount) != static_cast<double>(view.bytes.size()))
        length.refuse(fmt::format("{}, the size of the decompressed elements", view.bytes.size()));
    view.stride = strideOf(JsonObject(node));
    return view;
}

BufferView Buffers::view(std::size_t index) {
    if (const auto known = views_.find(index); known != views_.end())
        return known->second;
    const JsonNode node = document_.at("bufferViews", index);
    const std::optional<JsonObject> compression = extensionOf(JsonObject(node), "EXT_meshopt_compression");
    const BufferView view = compression ? decompressedView(node, *compression) : plainView(node);
    views_.emplace(index, view);
    return view;
}

} // namespace hyalite::core::gltf
