// Buffers and buffer views of a glTF file (glTF 2.0, section 3.6.1), read when they are first used; and views that
// EXT_meshopt_compression has compressed.
#pragma once

#include "host/import/file_access.h"
#include "host/import/gltf/document.h"
#include "host/import/gltf/memory_budget.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core::gltf {

/// A part of a buffer.
struct BufferView {
    std::span<const std::byte> bytes;
    std::size_t stride = 0; ///< from one element to the next; 0: they are packed
};

class Buffers {
  public:
    /// All three outlive the object.
    Buffers(const Document &document, const FileAccess &access, MemoryBudget &memoryBudget)
        : document_(document), access_(access), memoryBudget_(memoryBudget) {}
    Buffers(const Buffers &) = delete;
    Buffers &operator=(const Buffers &) = delete;

    /// The view lasts as long as this object. Throws Error{BadInput} for a view that does not lie in its buffer, for
    /// buffers that are missing or too short, and for damaged compression.
    [[nodiscard]] BufferView view(std::size_t index);

    [[nodiscard]] const Document &document() const { return document_; }
    [[nodiscard]] MemoryBudget &memoryBudget() { return memoryBudget_; }
    /// Files that were read.
    [[nodiscard]] const std::vector<std::filesystem::path> &files() const { return files_; }

  private:
    std::span<const std::byte> buffer(std::size_t index);
    std::vector<std::byte> readBuffer(const JsonNode &uri);
    BufferView plainView(const JsonNode &node);
    BufferView decompressedView(const JsonNode &node, const JsonObject &compression);

    const Document &document_;
    const FileAccess &access_;
    MemoryBudget &memoryBudget_;
    std::map<std::size_t, std::span<const std::byte>> buffers_;
    std::map<std::size_t, BufferView> views_;
    std::map<std::string, std::span<const std::byte>> fileContents_; ///< by path: each file is read once
    std::vector<std::unique_ptr<std::vector<std::byte>>> storage_;
    std::vector<std::filesystem::path> files_;
};

} // namespace hyalite::core::gltf
