// Strict, typed and range-checked access to JSON values. Knows nothing about scenes.
//
// Every refusal is an Error{BadInput} "FILE: /path/to/the/key: found ...; allowed: ...".
#pragma once

#include "host/base/error.h"
#include "host/base/interval.h"
#include "host/base/json_document.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace hyalite::core {

/// A value with its position. It refers to a document and a file name, which outlive it.
struct JsonNode {
    const nlohmann::json *value;
    const std::string *fileName;
    nlohmann::json::json_pointer path{};

    /// Throws "found <the value>; allowed: <allowed>" at this path.
    [[noreturn]] void refuse(std::string_view allowed) const;
    /// Throws `message` at this path.
    [[noreturn]] void fail(std::string_view message, Remedy remedy = Remedy::None) const;

    /// Interval::rounded() of it.
    [[nodiscard]] double number(const Interval &allowed) const;
    [[nodiscard]] glm::dvec3 vector(const Interval &allowed) const; ///< [x, y, z]
    [[nodiscard]] glm::dvec2 pair(const Interval &allowed) const;   ///< [u, v], or one number for both
    [[nodiscard]] glm::dvec3 colour(const Interval &allowed) const; ///< [r, g, b], or a number for grey
    [[nodiscard]] double wholeNumber(const Interval &allowed) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;                                               ///< without NUL
    [[nodiscard]] std::size_t indexOfName(std::span<const std::string_view> names) const; ///< in `names`
};

/// The faults of a document's independent parts, to tell them all at once.
class JsonFaults {
  public:
    /// Calls `read`, and keeps its Error{BadInput}. Throws all faults when there are too many to show.
    template <class Read> void collect(const Read &read) {
        try {
            read();
        } catch (const Error &error) {
            keep(error);
        }
    }
    /// Throws JsonError if there is any.
    void throwThem() const;

  private:
    void keep(const Error &error);

    std::vector<JsonFault> faults_;
    Remedy remedy_ = Remedy::None;
};

/// An object's members by key. A getter without a fallback demands the key. null is as good as no key, as programs
/// write it.
class JsonObject {
  public:
    /// Throws unless the value is an object.
    explicit JsonObject(JsonNode node);
    JsonObject(JsonNode node, std::span<const std::string_view> keys) : JsonObject(std::move(node)) {
        allowOnly(keys);
    }

    /// Throws for keys that are not listed, and suggests the most similar one. Every object may have a "description":
    /// JSON has no comments. It is a text, and is passed over.
    void allowOnly(std::span<const std::string_view> keys) const;

    [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;
    [[nodiscard]] JsonNode at(std::string_view key) const;
    [[nodiscard]] std::optional<JsonObject> object(std::string_view key,
                                                   std::span<const std::string_view> keys) const;
    /// The elements of an array; none where the key is absent.
    [[nodiscard]] std::vector<JsonNode> elements(std::string_view key, std::size_t maxCount) const;
    /// The members of this object, by name.
    [[nodiscard]] std::vector<std::pair<std::string, JsonNode>> members(std::size_t maxCount) const;

    [[nodiscard]] double number(std::string_view key, const Interval &allowed,
                                std::optional<double> fallback = {}) const {
        return read(key, fallback, [&](const JsonNode &node) { return node.number(allowed); });
    }
    [[nodiscard]] glm::dvec3 vector(std::string_view key, const Interval &allowed,
                                    std::optional<glm::dvec3> fallback = {}) const {
        return read(key, fallback, [&](const JsonNode &node) { return node.vector(allowed); });
    }
    [[nodiscard]] glm::dvec3 colour(std::string_view key, const Interval &allowed,
                                    std::optional<glm::dvec3> fallback = {}) const {
        return read(key, fallback, [&](const JsonNode &node) { return node.colour(allowed); });
    }
    [[nodiscard]] glm::dvec2 pair(std::string_view key, const Interval &allowed,
                                  std::optional<glm::dvec2> fallback = {}) const {
        return read(key, fallback, [&](const JsonNode &node) { return node.pair(allowed); });
    }
    template <std::integral T>
    [[nodiscard]] T integer(std::string_view key, const Interval &allowed, T fallback) const {
        return read<T>(key, fallback,
                       [&](const JsonNode &node) { return static_cast<T>(node.wholeNumber(allowed)); });
    }
    [[nodiscard]] bool boolean(std::string_view key, std::optional<bool> fallback = {}) const {
        return read(key, fallback, [](const JsonNode &node) { return node.boolean(); });
    }
    [[nodiscard]] std::string text(std::string_view key,
                                   const std::optional<std::string> &fallback = {}) const {
        return read(key, fallback, [](const JsonNode &node) { return node.text(); });
    }
    /// One of a few names, each with its value.
    template <class T>
    [[nodiscard]] T choice(std::string_view key, std::span<const std::pair<std::string_view, T>> choices,
                           std::optional<std::type_identity_t<T>> fallback = {}) const {
        return read(key, fallback, [&](const JsonNode &node) {
            std::vector<std::string_view> names;
            for (const auto &[name, meaning] : choices)
                names.push_back(name);
            return choices[node.indexOfName(names)].second;
        });
    }
    template <class T, std::size_t count>
    [[nodiscard]] T choice(std::string_view key,
                           const std::array<std::pair<std::string_view, T>, count> &choices,
                           std::optional<std::type_identity_t<T>> fallback = {}) const {
        return choice(key, std::span<const std::pair<std::string_view, T>>(choices), fallback);
    }

  private:
    template <class T, class Read>
    [[nodiscard]] T read(std::string_view key, const std::optional<T> &fallback, const Read &readNode) const {
        const std::optional<JsonNode> node = find(key);
        return !node && fallback ? *fallback : readNode(at(key));
    }
    JsonNode node_;
};

/// `; did you mean "centre"?` for the candidate nearest to `word`, or nothing where none is near. A word that other
/// programs have for a candidate, or that is a part of one, is near.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string_view> candidates);

/// `"a", "b", "c"`, safe for terminals; `...` after 32 names.
[[nodiscard]] std::string quotedList(std::span<const std::string_view> words);

} // namespace hyalite::core
