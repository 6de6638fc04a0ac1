// The document of a glTF file (glTF 2.0, sections 3 and 4): its JSON, its binary chunk, references between its objects.
//
// Everything that is refused is an Error{BadInput} "FILE: /path/to/the/key: found ...; allowed: ...".
#pragma once

#include "host/base/interval.h"
#include "host/base/json_reader.h"
#include "host/import/losses.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core::gltf {

/// Of counts, offsets and lengths in bytes: whole numbers that a double holds exactly.
inline constexpr Interval byteCount{0.0, 9007199254740991.0};
inline constexpr Interval anyNumber{-3.4028234663852886e38, 3.4028234663852886e38}; ///< a finite float

class Document {
  public:
    /// Reads a .gltf or a .glb, told apart by its first bytes, without the files that it names. Versions other than 2
    /// are refused. A member that is null counts as absent, and lengths of a .glb that are wrong count as what the file
    /// has, if chunks are whole.
    explicit Document(const std::filesystem::path &file);

    [[nodiscard]] const std::filesystem::path &path() const { return path_; }
    [[nodiscard]] const std::string &fileName() const { return fileName_; }
    [[nodiscard]] std::uint64_t sizeBytes() const { return sizeBytes_; } ///< of the file
    /// The binary chunk of a .glb; empty where there is none.
    [[nodiscard]] std::span<const std::byte> binaryChunk() const { return binaryChunk_; }

    [[nodiscard]] JsonObject top() const { return JsonObject(topNode()); }
    [[nodiscard]] JsonNode topNode() const { return {&json_, &fileName_}; }

    /// Changes and omissions of readers, for warnings.
    [[nodiscard]] Losses &losses() const { return *losses_; }

    /// How many elements an array of the top level has; 0 without it.
    [[nodiscard]] std::size_t count(std::string_view array) const;
    /// An element of it.
    [[nodiscard]] JsonNode at(std::string_view array, std::size_t index) const;
    /// The index in that array that the node says.
    [[nodiscard]] std::size_t reference(const JsonNode &node, std::string_view array) const;
    /// The same of a member, which may be missing.
    [[nodiscard]] std::optional<std::size_t> reference(const JsonObject &object, std::string_view key,
                                                       std::string_view array) const;

  private:
    std::filesystem::path path_;
    std::string fileName_;
    nlohmann::json json_;
    std::vector<std::byte> binaryChunk_;
    std::uint64_t sizeBytes_ = 0;
    std::unique_ptr<Losses> losses_ = std::make_unique<Losses>();
};

/// The elements of an array, each made when it is asked for: all of them, with their paths, would take many times the
/// memory of the file.
class Elements {
  public:
    class Iterator {
      public:
        Iterator(const Elements &elements, std::size_t index) : elements_(elements), index_(index) {}
        JsonNode operator*() const { return elements_[index_]; }
        Iterator &operator++() {
            ++index_;
            return *this;
        }
        bool operator!=(const Iterator &other) const { return index_ != other.index_; }

      private:
        const Elements &elements_;
        std::size_t index_;
    };

    Elements() = default;
    explicit Elements(JsonNode array) : array_(std::move(array)) {}

    [[nodiscard]] std::size_t size() const { return array_ ? array_->value->size() : 0; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] JsonNode operator[](std::size_t index) const {
        return {&(*array_->value)[index], array_->fileName, array_->path / index};
    }
    [[nodiscard]] Iterator begin() const { return {*this, 0}; }
    [[nodiscard]] Iterator end() const { return {*this, size()}; }

  private:
    std::optional<JsonNode> array_;
};

/// The elements of an array in an object; none where the key is missing.
[[nodiscard]] Elements elementsOf(const JsonObject &object, std::string_view key);

/// The numbers of an array, exactly `count` of them.
[[nodiscard]] std::vector<double> numbersOf(const JsonNode &node, std::size_t count,
                                            const Interval &allowed = anyNumber);

/// A number, or the nearest one in the range, which includes its ends, with a warning.
[[nodiscard]] double clampedNumber(const Document &document, const JsonNode &node, const Interval &allowed);
/// The same of a member; `fallback` without it.
[[nodiscard]] double clampedNumber(const Document &document, const JsonObject &object, std::string_view key,
                                   const Interval &allowed, double fallback);
/// The same of an array of `count` numbers.
[[nodiscard]] std::vector<double> clampedNumbers(const Document &document, const JsonNode &node,
                                                 std::size_t count, const Interval &allowed);

/// The object of an extension, if this object has it.
[[nodiscard]] std::optional<JsonObject> extensionOf(const JsonObject &object, std::string_view name);

/// The member "name", for messages and choices; empty without it.
[[nodiscard]] std::string nameOf(const JsonObject &object);

} // namespace hyalite::core::gltf
