// Accessors of a glTF file (glTF 2.0, section 3.6.2): typed elements in buffer views, sparse ones included.
#pragma once

#include "host/import/gltf/buffers.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core::gltf {

enum class ComponentType {
    Byte = 5120,
    UnsignedByte = 5121,
    Short = 5122,
    UnsignedShort = 5123,
    UnsignedInt = 5125,
    Float = 5126
};

/// Elements are decoded when they are asked for, so that many meshes may share one large accessor.
class Accessor {
  public:
    /// All elements lie in their buffer views. `buffers` outlives the object. Throws Error{BadInput} otherwise.
    Accessor(Buffers &buffers, std::size_t index);
    /// Numbers from elsewhere, instead of those of the accessor.
    Accessor(Buffers &buffers, std::size_t index, std::vector<float> numbers);

    Accessor(const Accessor &) = delete;
    Accessor &operator=(const Accessor &) = delete;
    Accessor(Accessor &&) = default;
    Accessor &operator=(Accessor &&) = default;

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t componentCount() const { return componentCount_; }
    [[nodiscard]] std::string_view type() const { return type_; } ///< "SCALAR", "VEC3" and so on
    [[nodiscard]] const JsonNode &node() const { return node_; }

    /// A number of an element: integers as they are, or normalised ones in [0, 1] or [-1, 1]. Throws Error{BadInput} at
    /// the accessor for numbers that are not finite.
    [[nodiscard]] float number(std::size_t element, std::size_t component) const;
    /// The same of an unsigned integer that is not normalised.
    [[nodiscard]] std::uint32_t whole(std::size_t element, std::size_t component = 0) const;

    [[nodiscard]] glm::vec2 vec2(std::size_t element) const;
    [[nodiscard]] glm::vec3 vec3(std::size_t element) const;
    [[nodiscard]] glm::vec4 vec4(std::size_t element) const;

    /// Throws Error{BadInput} at the accessor unless it has one of these types.
    void requireType(std::span<const std::string_view> types) const;
    void requireType(std::string_view type) const { requireType(std::span(&type, 1)); }
    /// Throws unless its components are unsigned integers.
    void requireUnsigned() const;
    /// Throws unless it has that many elements.
    void requireCount(std::size_t count) const;

  private:
    struct Sparse {
        std::vector<std::uint32_t> indices; ///< ascending
        std::span<const std::byte> values;
    };

    void readHeader(const Buffers &buffers);
    /// Elements need not be aligned.
    [[nodiscard]] static std::span<const std::byte> elementsIn(Buffers &buffers, const JsonObject &object,
                                                               std::size_t count, std::size_t elementBytes,
                                                               std::size_t &stride);
    void readSparse(Buffers &buffers, const JsonObject &sparse);
    [[nodiscard]] const std::byte *at(std::size_t element, std::size_t component) const;

    JsonNode node_;
    ComponentType componentType_ = ComponentType::Float;
    std::string_view type_;
    std::size_t componentCount_ = 0;
    std::size_t componentBytes_ = 0;
    std::size_t columnBytes_ = 0; ///< of matrices, whose columns begin at multiples of 4 bytes
    std::size_t rowCount_ = 0;    ///< components of a column
    std::size_t count_ = 0;
    bool isNormalized_ = false;
    bool isUnsigned_ = false;            ///< in the file
    std::span<const std::byte> bytes_{}; ///< empty: all elements are 0
    std::size_t stride_ = 0;
    std::optional<Sparse> sparse_{};
    std::vector<float> own_{};
};

} // namespace hyalite::core::gltf
